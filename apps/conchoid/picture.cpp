#include "conchoid/io/picture.hpp"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <filesystem>
#include <memory>
#include <nlohmann/json.hpp>

#include "command.hpp"
#include "conchoid/core/error.hpp"
#include "conchoid/io/run_folder.hpp"

namespace conchoid {
namespace {

struct PictureCommand {
  std::vector<std::string> runs;
  std::string out;
  double explode = 0.25;
  PictureSettings settings;
};

std::string method_title(const std::string& method) {
  if (method == "bem") return "solved by boundary elements";
  if (method == "forest") return "predicted by a forest";
  if (method == "steady") return "predicted, K stays as it is";
  return method;
}

PicturePanel panel_of(const RunData& run, double explode) {
  const RunDocument& d = run.document;
  PicturePanel panel;
  panel.title = method_title(d.method);
  panel.caption = fmt::format("{} after {} frames, {} piece{}, {:.2f} s", d.stop, d.frames,
                              run.fragments.size(), run.fragments.size() == 1 ? "" : "s", d.total_seconds);
  if (run.fragments.empty())
    panel.meshes = crack_in_body({}, run.crack);
  else if (run.fragments.size() == 1)
    panel.meshes = crack_in_body(run.fragments.front().mesh, run.crack);
  else
    panel.meshes = exploded(run.fragments, explode);
  return panel;
}

void draw_and_print(const PictureCommand& command, const CommonOptions& common) {
  if (std::filesystem::path(command.out).extension() != ".png")
    throw InputError(command.out + ": pictures are written as PNG; name a file that ends in .png");
  std::vector<PicturePanel> panels;
  for (const std::string& run : command.runs)
    panels.push_back(panel_of(read_run(run), command.explode));
  write_picture(command.out, panels, command.settings);
  print(common.json ? nlohmann::ordered_json{{"file", command.out}, {"runs", command.runs}}.dump()
                    : command.out);
}

}  // namespace

void add_picture(CLI::App& program, Invocation& invocation) {
  const auto options = std::make_shared<PictureCommand>();
  CLI::App* command =
      add_command(program, invocation, "picture", "Draw the pieces of runs side by side (PNG)",
                  [options, &invocation] { draw_and_print(*options, invocation.common); });
  command->add_option("RUN", options->runs, "run folders written by conchoid run --out")
      ->required()
      ->expected(1, 8);
  command->add_option("--out", options->out, "picture to write (.png)")->required();
  command
      ->add_option("--explode", options->explode,
                   "how far the pieces are moved apart, as a share of their distance")
      ->check(CLI::Range(0.0, 10.0))
      ->capture_default_str();
  command->add_option("--width", options->settings.width, "pixels")
      ->check(CLI::Range(64, 8192))
      ->capture_default_str();
  command->add_option("--height", options->settings.height, "pixels")
      ->check(CLI::Range(64, 8192))
      ->capture_default_str();
}

}  // namespace conchoid
