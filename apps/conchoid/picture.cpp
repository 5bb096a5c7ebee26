#include "conchoid/io/picture.hpp"

#include <CLI/CLI.hpp>
#include <cmath>
#include <filesystem>
#include <memory>
#include <nlohmann/json.hpp>

#include "command.hpp"
#include "conchoid/core/error.hpp"
#include "conchoid/io/run_pictures.hpp"
#include "conchoid/sim/methods.hpp"

namespace conchoid {
namespace {

struct PictureCommand {
  std::vector<std::string> runs;
  std::string out, show = "pieces", up = "auto";
  std::vector<double> from;
  int sheet = 0;  ///< frames on a contact sheet; 0: one panel per run
  bool plain = false;
  RunPictureSettings run;
  PictureSettings settings;
};

Vec3 up_direction(const std::string& name, const std::string& folder) {
  if (name == "auto") return usual_up(read_run_json(std::filesystem::path(folder) / "run.json"));
  const double sign = name.front() == '-' ? -1 : 1;
  return sign * Vec3::Unit(name.back() - 'x');
}

/// The usual direction to the eye, from the front, the right and above, whichever way is up.
Vec3 usual_view(const Vec3& up) {
  const PictureSettings usual;
  const Vec3 right = up.x() != 0 ? Vec3::UnitY() : Vec3::UnitX(), front = cross(right, up);
  return usual.from.x() * right - usual.from.y() * front + usual.from.z() * up;
}

PicturePanel titled_panel(const RunData& run, const std::string& folder, const RunPictureSettings& settings) {
  PicturePanel panel = run_panel(run, folder, settings);
  if (const OpeningMethod* method = find_opening_method(run.document.method)) panel.title = method->title;
  return panel;
}

std::vector<PicturePanel> panels_of(const PictureCommand& command) {
  std::vector<PicturePanel> panels;
  for (const std::string& folder : command.runs) {
    const RunData run = read_run(folder);
    if (command.sheet > 0)
      for (PicturePanel& panel : frame_panels(run, folder, command.sheet, command.run))
        panels.push_back(std::move(panel));
    else
      panels.push_back(titled_panel(run, folder, command.run));
  }
  if (command.plain)
    for (PicturePanel& panel : panels)
      panel.title = panel.caption = "";
  return panels;
}

void draw_and_print(PictureCommand command, const CommonOptions& common) {
  if (std::filesystem::path(command.out).extension() != ".png")
    throw InputError(command.out + ": pictures are written as PNG; name a file that ends in .png");
  if (command.sheet > 0 && command.runs.size() > 1)
    throw InputError("--sheet shows the frames of one run; name one folder");
  command.run.view = run_view_from_name(command.show);
  command.settings.up = up_direction(command.up, command.runs.front());
  command.settings.from = command.from.empty() ? usual_view(command.settings.up)
                                               : Vec3(command.from[0], command.from[1], command.from[2]);
  if (command.settings.from.isZero(0))
    throw InputError("--from 0,0,0 is no direction; name where to look from");
  const std::vector<PicturePanel> panels = panels_of(command);
  if (command.sheet > 0)
    command.settings.columns = static_cast<int>(std::ceil(std::sqrt(static_cast<double>(panels.size()))));
  write_picture(command.out, panels, command.settings);
  print(common.json ? nlohmann::ordered_json{{"file", command.out}, {"runs", command.runs}}.dump()
                    : command.out);
}

}  // namespace

void add_picture(CLI::App& program, Invocation& invocation) {
  const auto options = std::make_shared<PictureCommand>();
  CLI::App* command = add_command(program, invocation, "picture",
                                  "Draw runs: pieces, crack surface, K, opening, frames (PNG)",
                                  [options, &invocation] { draw_and_print(*options, invocation.common); });
  command->add_option("RUN", options->runs, "run folders written by conchoid run --out")
      ->required()
      ->expected(1, 8);
  command->add_option("--out", options->out, "picture to write (.png)")->required();
  command
      ->add_option("--show", options->show,
                   "pieces moved apart, the crack surface alone, or K or the opening as colours")
      ->check(CLI::IsMember({"pieces", "crack", "K", "opening"}))
      ->capture_default_str();
  command
      ->add_option(
          "--sheet", options->sheet,
          "contact sheet: so many frames of one run, coloured by opening (or K with --show K); 0: none")
      ->check(CLI::Range(0, 64))
      ->capture_default_str();
  command
      ->add_option("--explode", options->run.explode,
                   "how far the pieces are moved apart, as a share of their distance")
      ->check(CLI::Range(0.0, 10.0))
      ->capture_default_str();
  command
      ->add_option("--exaggerate", options->run.exaggerate,
                   "the crack's faces are drawn apart by so many times the opening")
      ->check(CLI::Range(0.0, 1e9))
      ->capture_default_str();
  command
      ->add_option("--up", options->up,
                   "axis that points up: x, y, z, -x, -y, -z; auto: y where the body is clearly tallest "
                   "along it, else z")
      ->check(CLI::IsMember({"auto", "x", "y", "z", "-x", "-y", "-z"}))
      ->capture_default_str();
  command
      ->add_option("--from", options->from,
                   "direction to look from, X,Y,Z; from the front right above otherwise")
      ->delimiter(',')
      ->expected(3);
  command->add_option("--width", options->settings.width, "pixels")
      ->check(CLI::Range(64, 8192))
      ->capture_default_str();
  command->add_option("--height", options->settings.height, "pixels")
      ->check(CLI::Range(64, 8192))
      ->capture_default_str();
  command
      ->add_option("--samples", options->settings.samples,
                   "rays per pixel and direction: smoother and slower")
      ->check(CLI::Range(1, 16))
      ->capture_default_str();
  command->add_flag("--plain", options->plain, "no title and no caption");
}

}  // namespace conchoid
