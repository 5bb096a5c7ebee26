#include "conchoid/study/compare.hpp"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <memory>

#include "command.hpp"
#include "conchoid/core/log.hpp"

namespace conchoid {
namespace {

struct CompareOptions {
  std::string a, b;
};

std::string comparison_text(const Comparison& c) {
  const double percent = 100 / c.bbox_diagonal;
  return fmt::format(
      "distance of the crack surfaces  mean {:.4g} m ({:.2f} % of the diagonal), 95 % below {:.4g} m ({:.2f} "
      "%)\n"
      "frames                          {} and {}\n"
      "error of log K                  I {:.3g}, II {:.3g}, III {:.3g}\n"
      "crack area, second over first   {:.4g}\n"
      "largest fragments, overlap      {:.4g} (intersection over union)",
      c.surface_mean, c.surface_mean * percent, c.surface_p95, c.surface_p95 * percent, c.frames[0],
      c.frames[1], c.sif_log_error[0], c.sif_log_error[1], c.sif_log_error[2], c.area_ratio,
      c.largest_fragment_iou);
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
