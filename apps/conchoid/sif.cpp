#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <memory>

#include "command.hpp"
#include "conchoid/sim/reports.hpp"
#include "conchoid/sim/settings.hpp"
#include "json.hpp"

namespace conchoid {
namespace {

using nlohmann::ordered_json;

std::string sif_json(const SifReport& report) {
  ordered_json fronts = ordered_json::array();
  for (const SifReport::FrontLine& front : report.fronts) {
    ordered_json nodes = ordered_json::array();
    for (const SifNode& node : front.nodes)
      nodes.push_back({{"x", to_json(node.position)},
                       {"K", to_json(node.intensity)},
                       {"e1", to_json(node.frame.e1)},
                       {"e2", to_json(node.frame.e2)},
                       {"e3", to_json(node.frame.e3)}});
    fronts.push_back({{"closed", front.closed}, {"nodes", std::move(nodes)}});
  }
  return ordered_json{{"fronts", std::move(fronts)},
                      {"triangles", report.triangles},
                      {"opened_volume", number(report.opened_volume)},
                      {"elements", report.elements},
                      {"warnings", report.warnings},
                      {"seconds", report.seconds}}
      .dump();
}

std::string sif_text(const SifReport& report) {
  std::string text =
      fmt::format("{} crack triangles, opened volume {:.6g} m³", report.triangles, report.opened_volume);
  for (std::size_t f = 0; f < report.fronts.size(); ++f) {
    const SifReport::FrontLine& front = report.fronts[f];
    text += fmt::format("\nfront {} ({}, {} nodes)\n{:>12} {:>12} {:>12} {:>14} {:>14} {:>14}   m, Pa√m", f,
                        front.closed ? "closed" : "open", front.nodes.size(), "x", "y", "z", "K_I", "K_II",
                        "K_III");
    for (const SifNode& n : front.nodes)
      text += fmt::format("\n{:12.5g} {:12.5g} {:12.5g} {:14.6g} {:14.6g} {:14.6g}", n.position.x(),
                          n.position.y(), n.position.z(), n.intensity[0], n.intensity[1], n.intensity[2]);
  }
  return text;
}

}  // namespace

void add_sif(CLI::App& program, Invocation& invocation) {
  const auto file = std::make_shared<std::string>(), cache = std::make_shared<std::string>();
  CLI::App* command = add_command(program, invocation, "sif",
                                  "Stress intensity factors along the initial crack fronts; nothing grows",
                                  [file, cache, &invocation] {
                                    Scene scene = read_scene(*file);
                                    scene.run.cache = open_cache(*cache);
                                    const SifReport report = compute_sifs(scene);
                                    print(invocation.common.json ? sif_json(report) : sif_text(report));
                                  });
  command->add_option("SCENE", *file, "scene file (TOML)")->required();
  add_cache_option(*command, *cache);
  command->footer(
      "K in Pa√m: K_I opening, K_II in-plane, K_III anti-plane, in the frame e1 (crack normal), e2 "
      "(forward),\n"
      "e3 (tangent). The keys of a scene: conchoid help-scene.");
}

}  // namespace conchoid
