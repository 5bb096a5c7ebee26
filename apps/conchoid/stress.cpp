#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <map>
#include <memory>

#include "command.hpp"
#include "conchoid/sim/reports.hpp"
#include "json.hpp"

namespace conchoid {
namespace {

using nlohmann::ordered_json;

std::string stress_json(const StressReport& report) {
  ordered_json triangles = ordered_json::array();
  for (const StressReport::SurfaceTriangle& t : report.triangles)
    triangles.push_back(
        {{"centroid", to_json(t.centroid)}, {"principal", to_json(t.principal)}, {"region", t.region}});
  return ordered_json{{"max_principal", number(report.max_principal)},
                      {"max_displacement", number(report.max_displacement)},
                      {"triangles", std::move(triangles)},
                      {"elements", report.elements},
                      {"warnings", report.warnings},
                      {"seconds", report.seconds}}
      .dump();
}

std::string stress_text(const StressReport& report) {
  std::string text =
      fmt::format("largest principal stress {:.6g} Pa ({} elements)\n{:<20} {:>10} {:>14} {:>14}",
                  report.max_principal, report.elements, "region", "triangles", "smallest σ1", "largest σ1");
  struct Extent {
    std::size_t count = 0;
    double low = 0, high = 0;
  };
  std::map<std::string, Extent> regions;
  for (const StressReport::SurfaceTriangle& t : report.triangles) {
    Extent& e = regions[t.region.empty() ? "(none)" : t.region];
    e.low = e.count == 0 ? t.principal[0] : std::min(e.low, t.principal[0]);
    e.high = e.count == 0 ? t.principal[0] : std::max(e.high, t.principal[0]);
    ++e.count;
  }
  for (const auto& [name, e] : regions)
    text += fmt::format("\n{:<20} {:>10} {:14.6g} {:14.6g}", name, e.count, e.low, e.high);
  return text;
}

}  // namespace

void add_stress(CLI::App& program, Invocation& invocation) {
  const auto file = std::make_shared<std::string>(), cache = std::make_shared<std::string>();
  CLI::App* command =
      add_command(program, invocation, "stress", "Stress on the surface of the body as it stands",
                  [file, cache, &invocation] {
                    Scene scene = read_scene(*file);
                    scene.run.cache = open_cache(*cache);
                    const StressReport report = compute_stress(scene);
                    print(invocation.common.json ? stress_json(report) : stress_text(report));
                  });
  command->add_option("SCENE", *file, "scene file (TOML)")->required();
  add_cache_option(*command, *cache);
  command->footer("Principal stresses in Pa, tension positive. The keys of a scene: conchoid help-scene.");
}

}  // namespace conchoid
