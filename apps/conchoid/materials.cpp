#include <fmt/format.h>

#include <CLI/CLI.hpp>

#include "command.hpp"
#include "conchoid/material/library.hpp"
#include "json.hpp"

namespace conchoid {
namespace {

using nlohmann::ordered_json;

std::string materials_json() {
  ordered_json list = ordered_json::array();
  for (const NamedMaterial& m : named_materials())
    list.push_back({{"name", m.name},
                    {"youngs_modulus", m.youngs_modulus},
                    {"poisson_ratio", m.poisson_ratio},
                    {"density", m.density},
                    {"strength", m.strength},
                    {"toughness", m.toughness},
                    {"source", m.source}});
  return ordered_json{{"materials", std::move(list)}}.dump();
}

std::string materials_text() {
  std::string text = fmt::format("{:<12} {:>9} {:>7} {:>9} {:>13} {:>15}", "name", "E [GPa]", "ν",
                                 "ρ [kg/m³]", "strength [MPa]", "toughness [MPa√m]");
  for (const NamedMaterial& m : named_materials())
    text += fmt::format("\n{:<12} {:9g} {:6g} {:9g} {:14g} {:17g}\n    {}", m.name, m.youngs_modulus / 1e9,
                        m.poisson_ratio, m.density, m.strength / 1e6, m.toughness / 1e6, m.source);
  return text;
}

}  // namespace

void add_materials(CLI::App& program, Invocation& invocation) {
  CLI::App* command =
      add_command(program, invocation, "materials", "List the materials that a scene can name, with sources",
                  [&invocation] { print(invocation.common.json ? materials_json() : materials_text()); });
  command->footer("In a scene: [material] name = \"glass\". Single keys beside it override its constants.");
}

}  // namespace conchoid
