#include "conchoid/study/compare.hpp"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <memory>
#include <numbers>

#include "command.hpp"
#include "conchoid/core/log.hpp"

namespace conchoid {
namespace {

constexpr double kDegrees = 180 / std::numbers::pi;

struct CompareOptions {
  std::string a, b;
};

std::string volumes_text(const std::vector<double>& volumes) {
  if (volumes.empty()) return "none";
  std::string text;
  for (const double v : volumes)
    text += fmt::format("{}{:.4g}", text.empty() ? "" : ", ", v);
  return text;
}

std::string distance_text(double distance, const Comparison& c) {
  return fmt::format("{:.4g} m ({:.2f} % of the body's diagonal, {:.2f} % of the crack's)", distance,
                     100 * distance / c.bbox_diagonal, 100 * distance / c.crack_diagonal);
}

std::string history_text(const std::vector<FrameComparison>& history) {
  if (history.empty()) return "";
  std::string text =
      "\n\nframe  crack area, m²          K_I, Pa√m               K_II                    K_III              "
      " "
      "    front apart, m  kink, °";
  for (const FrameComparison& f : history) {
    text += fmt::format("\n{:5}  {:.4g} and {:.4g}", f.frame, f.crack_area[0], f.crack_area[1]);
    for (int mode = 0; mode < 3; ++mode)
      text += fmt::format("   {:.3g} and {:.3g}", f.intensity[0][mode], f.intensity[1][mode]);
    text += fmt::format("   {:.3g}   {:.2f}", f.front_distance, f.kink_angle * kDegrees);
  }
  return text;
}

std::string comparison_text(const Comparison& c) {
  return fmt::format(
             "distance of the crack surfaces  mean {}\n"
             "                                95 % below {}\n"
             "distance of the fronts          {}, mean over the frames\n"
             "error of the kink angle         {:.2f}°\n"
             "frames                          {} and {}\n"
             "stop                            {} and {}\n"
             "error of log K                  I {:.3g}, II {:.3g}, III {:.3g}\n"
             "crack area, second over first   {:.4g}\n"
             "volumes of the fragments        {} and {} m³\n"
             "largest fragments, overlap      {:.4g} (intersection over union)\n"
             "fragments, Chamfer distance     {:.4g} m",
             distance_text(c.surface_mean, c), distance_text(c.surface_p95, c),
             distance_text(c.front_distance, c), c.kink_angle_error * kDegrees, c.frames[0], c.frames[1],
             name(c.stop[0]), name(c.stop[1]), c.sif_log_error[0], c.sif_log_error[1], c.sif_log_error[2],
             c.area_ratio, volumes_text(c.volumes[0]), volumes_text(c.volumes[1]), c.largest_fragment_iou,
             c.fragment_chamfer) +
         history_text(c.history);
}

void compare_and_print(const CompareOptions& options, const CommonOptions& common) {
  const Comparison comparison = compare_runs(options.a, options.b);
  if (!comparison.same_body) warning("the two runs are of different bodies; their distances mean little");
  print(common.json ? comparison_json(comparison) : comparison_text(comparison));
}

}  // namespace

void add_compare(CLI::App& program, Invocation& invocation) {
  const auto options = std::make_shared<CompareOptions>();
  CLI::App* command = add_command(program, invocation, "compare", "Metrics between two runs of one scene",
                                  [options, &invocation] { compare_and_print(*options, invocation.common); });
  command->add_option("RUN_A", options->a, "run folder written by conchoid run --out")->required();
  command->add_option("RUN_B", options->b, "the other one")->required();
}

}  // namespace conchoid
