#include "command.hpp"

#include <CLI/CLI.hpp>
#include <cstdio>

#include "conchoid/core/error.hpp"

namespace conchoid {

CLI::App* add_command(CLI::App& parent, Invocation& invocation, const std::string& name,
                      const std::string& help, std::function<void()> action) {
  CLI::App* command = parent.add_subcommand(name, help);
  CommonOptions& common = invocation.common;
  command
      ->add_option("--threads", common.threads,
                   "worker threads, 0: all of the machine; never changes a result")
      ->check(CLI::Range(0, 1024))
      ->capture_default_str();
  command->add_flag("--quiet", common.quiet,
                    "no messages and no progress on stderr (warnings and errors stay)");
  command->add_flag("--json", common.json, "one JSON object on stdout, nothing else there");
  command->callback([&invocation, action = std::move(action)] { invocation.action = action; });
  return command;
}

void allow_one_command(CLI::App& parent) {
  parent.require_subcommand(0, 1);
}

void add_cache_option(CLI::App& command, std::string& folder) {
  command.add_option(
      "--cache", folder,
      "folder for prepared bodies (remeshed surfaces, factored systems): a body that was there before, "
      "under whatever load, is not prepared again; never changes a result");
}

std::shared_ptr<const ByteCache> open_cache(const std::string& folder) {
  return folder.empty() ? nullptr : std::make_shared<const ByteCache>(folder);
}

void add_regressor_argument(CLI::App& command, std::string& file) {
  command
      .add_option("FILE", file,
                  "file written by forest train, or name of a database that comes with conchoid")
      ->required();
}

void print(const std::string& text) {
  if (std::puts(text.c_str()) < 0 || std::fflush(stdout) != 0)
    throw WriteError("stdout: the result could not be written; is the disk full or the pipe closed?");
}

}  // namespace conchoid
