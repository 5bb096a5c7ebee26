#include "cli/signalled.hpp"

#include <fcntl.h>
#include <sys/ptrace.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstring>
#include <stdexcept>
#include <thread>

namespace conchoid::test {
namespace {

/// @param traced  the child stops at its first instruction and waits for us
pid_t start_program(const std::vector<std::string>& arguments, const TemporaryFolder& folder, bool traced) {
  const pid_t child = ::fork();
  if (child != 0) return child;
  std::vector<char*> argv = {const_cast<char*>(CONCHOID_BINARY)};
  for (const std::string& argument : arguments)
    argv.push_back(const_cast<char*>(argument.c_str()));
  argv.push_back(nullptr);
  const int nowhere = ::open("/dev/null", O_RDWR);
  ::dup2(nowhere, STDOUT_FILENO);
  ::dup2(nowhere, STDERR_FILENO);
  if (::chdir(folder.path().c_str()) == 0 && (!traced || ::ptrace(PTRACE_TRACEME, 0, nullptr, nullptr) == 0))
    ::execv(CONCHOID_BINARY, argv.data());
  ::_exit(127);
}

int exit_status(int status) {
  return WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
}

int wait_for_end(pid_t child) {
  int status = 0;
  ::waitpid(child, &status, 0);
  return exit_status(status);
}

}  // namespace

int run_and_signal(const std::vector<std::string>& arguments, const TemporaryFolder& folder,
                   const std::function<bool()>& ready, int signal) {
  const pid_t child = start_program(arguments, folder, false);
  const auto deadline = std::chrono::steady_clock::now() + std::chrono::minutes(1);
  while (!ready() && std::chrono::steady_clock::now() < deadline)
    std::this_thread::sleep_for(std::chrono::milliseconds(2));
  ::kill(child, signal);
  return wait_for_end(child);
}

int run_and_signal_at_once(const std::vector<std::string>& arguments, const TemporaryFolder& folder,
                           const std::function<bool()>& ready, int signal) {
  const pid_t child = start_program(arguments, folder, true);
  while (true) {
    int status = 0;
    ::waitpid(child, &status, 0);
    if (!WIFSTOPPED(status)) return exit_status(status);
    if (ready()) break;
    // Whatever it stopped for that is not our own stepping is a signal of its own: hand it on.
    const int own = WSTOPSIG(status) == SIGTRAP ? 0 : WSTOPSIG(status);
    if (::ptrace(PTRACE_SYSCALL, child, nullptr, own) != 0)
      throw std::runtime_error(std::string("ptrace: ") + std::strerror(errno));
  }
  if (signal == SIGKILL) {
    ::kill(child, signal);
  } else {
    ::ptrace(PTRACE_DETACH, child, nullptr, signal);
  }
  return wait_for_end(child);
}

}  // namespace conchoid::test
