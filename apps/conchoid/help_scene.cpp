#include <CLI/CLI.hpp>
#include <memory>

#include "command.hpp"
#include "conchoid/sim/settings.hpp"

namespace conchoid {

void add_help_scene(CLI::App& program, Invocation& invocation) {
  const auto markdown = std::make_shared<bool>(false);
  CLI::App* command =
      add_command(program, invocation, "help-scene",
                  "List the keys of scenes and database specifications: units, ranges, defaults",
                  [markdown] { print(*markdown ? settings_markdown() : settings_text(true)); });
  command->add_flag("--markdown", *markdown, "as the tables of docs/scene.md");
}

}  // namespace conchoid
