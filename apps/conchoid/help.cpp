#include <CLI/CLI.hpp>
#include <memory>
#include <nlohmann/json.hpp>

#include "command.hpp"
#include "conchoid/core/error.hpp"

namespace conchoid {

void add_help(CLI::App& program, Invocation& invocation) {
  const auto name = std::make_shared<std::string>();
  CLI::App* command = add_command(program, invocation, "help", "This text, or that of a command", [&, name] {
    CLI::App* about = &program;
    if (!name->empty()) {
      const auto found = program.get_subcommands([&](CLI::App* c) { return c->get_name() == *name; });
      if (found.empty()) throw InputError("there is no command '" + *name + "'; conchoid help lists them");
      about = found.front();
    }
    const std::string text =
        about->get_formatter()->make_help(about, about->get_display_name(), CLI::AppFormatMode::Normal);
    print(invocation.common.json ? nlohmann::ordered_json{{"help", text}}.dump() : text);
  });
  command->add_option("COMMAND", *name, "tell about this one");
}

}  // namespace conchoid
