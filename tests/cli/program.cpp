#include "cli/program.hpp"

#include <sys/wait.h>

#include <cstdlib>

namespace conchoid::test {
namespace {

namespace fs = std::filesystem;

std::string quoted(const std::string& text) {
  std::string result = "'";
  for (char c : text)
    result += c == '\'' ? std::string("'\\''") : std::string(1, c);
  return result + "'";
}

}  // namespace

Outcome run_program(const std::vector<std::string>& arguments, const fs::path& folder) {
  std::vector<std::string> words{CONCHOID_BINARY};
  words.insert(words.end(), arguments.begin(), arguments.end());
  return run_command(words, folder);
}

Outcome run_command(const std::vector<std::string>& words, const fs::path& folder) {
  const TemporaryFolder captured;
  std::string command = "cd " + quoted(folder) + " &&";
  for (const std::string& word : words)
    command += " " + quoted(word);
  command += " >" + quoted(captured / "out") + " 2>" + quoted(captured / "err") + " </dev/null";
  const int status = std::system(command.c_str());
  Outcome outcome{.status = -1, .out = captured.read("out"), .err = captured.read("err")};
  if (WIFEXITED(status)) outcome.status = WEXITSTATUS(status);
  if (WIFSIGNALED(status)) outcome.status = 128 + WTERMSIG(status);
  return outcome;
}

std::vector<fs::path> files_below(const fs::path& folder) {
  std::vector<fs::path> files;
  for (const auto& entry : fs::recursive_directory_iterator(folder))
    if (!entry.is_directory()) files.push_back(entry.path());
  return files;
}

}  // namespace conchoid::test
