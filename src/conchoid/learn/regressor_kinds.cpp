#include "conchoid/learn/regressor_kinds.hpp"

#include <algorithm>
#include <cmath>
#include <sstream>
#include <stdexcept>

#include "conchoid/core/error.hpp"
#include "conchoid/learn/boosted_trees.hpp"
#include "conchoid/learn/forest.hpp"
#include "conchoid/learn/network.hpp"
#include "conchoid/learn/ridge.hpp"

namespace conchoid {
namespace {

const TrainingOption* find_option(const RegressorKind& kind, std::string_view name) {
  const auto found = std::find_if(kind.options.begin(), kind.options.end(),
                                  [name](const TrainingOption& o) { return o.name == name; });
  return found == kind.options.end() ? nullptr : &*found;
}

std::string option_names(const RegressorKind& kind) {
  std::string names;
  for (const TrainingOption& option : kind.options)
    names += (names.empty() ? "--" : ", --") + std::string(option.name);
  return names;
}

void check_options(const RegressorKind& kind, const TrainingSettings& settings) {
  for (const auto& [name, value] : settings.options) {
    const TrainingOption* option = find_option(kind, name);
    if (!option)
      throw InputError("--" + name + " is no option of a " + std::string(kind.title) + ", which has " +
                       option_names(kind) + "; leave it out or choose another --model");
    if (value >= option->minimum && value <= option->maximum &&
        (!option->whole || value == std::floor(value)))
      continue;
    std::ostringstream text;
    text << "--" << name << " = " << value << ": must be a " << (option->whole ? "whole number" : "number")
         << " from " << option->minimum << " to " << option->maximum;
    throw InputError(text.str());
  }
}

}  // namespace

const std::vector<RegressorKind>& regressor_kinds() {
  static const std::vector<RegressorKind> kinds = {
      forest_kind(),
      boosted_kind(),
      network_kind(),
      ridge_kind(),
  };
  return kinds;
}

const RegressorKind& regressor_kind(std::string_view name) {
  for (const RegressorKind& kind : regressor_kinds())
    if (kind.name == name) return kind;
  throw InputError("unknown kind of regressor '" + std::string(name) + "'; choose one of " +
                   regressor_names());
}

std::string regressor_names() {
  std::string names;
  for (const RegressorKind& kind : regressor_kinds())
    names += (names.empty() ? "" : ", ") + std::string(kind.name);
  return names;
}

std::unique_ptr<Regressor> train_regressor(const RegressorKind& kind, const SampleSet& samples,
                                           const TrainingSettings& settings, Provenance provenance,
                                           const TrainingProgress& progress) {
  check_options(kind, settings);
  return kind.train(samples, settings, std::move(provenance), progress);
}

std::optional<double> option_value(const RegressorKind& kind, const TrainingSettings& settings,
                                   std::string_view name) {
  const TrainingOption* option = find_option(kind, name);
  if (!option) throw std::logic_error("no option of this kind of regressor: " + std::string(name));
  const auto given = settings.options.find(name);
  return given == settings.options.end() ? option->standard : std::optional(given->second);
}

int whole_option_value(const RegressorKind& kind, const TrainingSettings& settings, std::string_view name) {
  return static_cast<int>(option_value(kind, settings, name).value());
}

}  // namespace conchoid
