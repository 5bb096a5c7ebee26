#include "conchoid/study/experiments/experiments.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "conchoid/core/error.hpp"

namespace conchoid {
namespace {

std::vector<Experiment> all_experiments() {
  std::vector<Experiment> all = database_experiments();
  for (auto* more : {&scene_experiments, &held_out_experiments, &uncertainty_experiments})
    for (Experiment& e : (*more)())
      all.push_back(std::move(e));
  // Tables before figures before studies, each by its number.
  const auto place = [](const Experiment& e) {
    const std::size_t dash = e.name.find('-');
    const std::string kind = e.name.substr(0, dash), number = e.name.substr(dash + 1);
    const bool counted = kind == "table" || kind == "figure";
    return std::tuple(kind == "table" ? 0 : kind == "figure" ? 1 : 2, counted ? std::stoi(number) : 0);
  };
  std::stable_sort(all.begin(), all.end(),
                   [&](const Experiment& a, const Experiment& b) { return place(a) < place(b); });
  return all;
}

}  // namespace

const std::vector<Experiment>& experiments() {
  static const std::vector<Experiment> all = all_experiments();
  return all;
}

const Experiment& experiment(std::string_view name) {
  std::vector<std::string> names;
  for (const Experiment& e : experiments()) {
    if (e.name == name) return e;
    names.push_back(e.name);
  }
  throw InputError(fmt::format("experiment '{}' is not known; use some of {}", name, fmt::join(names, ", ")));
}

}  // namespace conchoid
