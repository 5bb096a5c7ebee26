#include "conchoid/sim/methods.hpp"

#include <fmt/format.h>

#include "conchoid/core/error.hpp"
#include "conchoid/learn/regressor_kinds.hpp"
#include "conchoid/sim/stress_opening.hpp"

namespace conchoid {
namespace {

std::unique_ptr<OpeningSource> predicted_by(const OpeningPredictor& predictor, const MethodContext& c) {
  return std::make_unique<OpeningByPredictor>(c.prediction, predictor);
}

std::unique_ptr<OpeningSource> hybrid_source(const MethodContext& given) {
  MethodContext c = given;
  if (!c.prediction.tolerance) c.prediction.tolerance = kStandardTolerance;
  if (c.regressor) return predicted_by(*c.regressor, c);
  return std::make_unique<KeptOpening>(c.prediction);
}

OpeningMethod regressor_method(const RegressorKind& kind) {
  return {.name = std::string(kind.name),
          .title = fmt::format("predicted by a {}", kind.title),
          .help = fmt::format("solves frame 1, then predicts by a {}", kind.title),
          .regressor = std::string(kind.name),
          .baseline = nullptr,
          .make = [](const MethodContext& c) { return predicted_by(*c.regressor, c); }};
}

std::vector<OpeningMethod> list_methods() {
  std::vector<OpeningMethod> methods;
  methods.push_back({.name = "bem",
                     .title = "solved by boundary elements",
                     .help = "solves every frame",
                     .regressor = "",
                     .baseline = nullptr,
                     .make = [](const MethodContext&) { return nullptr; }});
  methods.push_back({.name = "steady",
                     .title = "predicted, K stays as it is",
                     .help = "solves frame 1, then keeps K as it is",
                     .regressor = "",
                     .baseline = &steady_predictor(),
                     .make = [](const MethodContext& c) { return predicted_by(steady_predictor(), c); }});
  methods.push_back(
      {.name = "kept",
       .title = "predicted, K stays as it is in the front's frame",
       .help = "solves frame 1, then keeps K as it is in the front's own frame",
       .regressor = "",
       .baseline = nullptr,
       .make = [](const MethodContext& c) { return std::make_unique<KeptOpening>(c.prediction); }});
  methods.push_back(
      {.name = "stress",
       .title = "predicted from the stress of the uncracked body",
       .help = "solves frame 1, then estimates K from the stress of the uncracked body and the crack's size",
       .regressor = "",
       .baseline = nullptr,
       .make = [](const MethodContext& c) { return std::make_unique<StressOpening>(c.prediction); }});
  methods.push_back(
      {.name = "hybrid",
       .title = "predicted, and solved where that may go astray",
       .help = "predicts by the database, and solves as many frames, mostly the first, as --tolerance "
               "asks for",
       .regressor = "",
       .hybrid = true,
       .baseline = nullptr,
       .make = hybrid_source});
  for (const RegressorKind& kind : regressor_kinds())
    methods.push_back(regressor_method(kind));
  return methods;
}

// "forest, ridge"
std::string trained_names() {
  std::vector<std::string> names;
  for (const OpeningMethod& method : opening_methods())
    if (!method.regressor.empty()) names.push_back(method.name);
  return fmt::format("{}", fmt::join(names, ", "));
}

}  // namespace

const std::vector<OpeningMethod>& opening_methods() {
  static const std::vector<OpeningMethod> methods = list_methods();
  return methods;
}

const OpeningMethod* find_opening_method(std::string_view name) {
  for (const OpeningMethod& method : opening_methods())
    if (method.name == name) return &method;
  return nullptr;
}

const OpeningMethod& opening_method(std::string_view name) {
  if (const OpeningMethod* method = find_opening_method(name)) return *method;
  std::vector<std::string> names;
  for (const OpeningMethod& method : opening_methods())
    names.push_back(method.name);
  throw InputError(fmt::format("method '{}' is not known; use one of {}", name, fmt::join(names, ", ")));
}

std::vector<const OpeningPredictor*> baseline_predictors() {
  std::vector<const OpeningPredictor*> predictors;
  for (const OpeningMethod& method : opening_methods())
    if (method.baseline) predictors.push_back(method.baseline);
  return predictors;
}

const OpeningMethod& checked_method(std::string_view name, const Regressor* regressor,
                                    const std::optional<double>& tolerance) {
  const OpeningMethod& method = opening_method(name);
  if (tolerance && !method.hybrid)
    throw InputError(
        fmt::format("a tolerance goes with --method hybrid, not with {}; leave out --tolerance", name));
  if (tolerance && !(*tolerance >= 0))
    throw InputError(fmt::format("--tolerance {}: must be 0 or above, inf among it", *tolerance));
  if (method.hybrid) return method;
  if (method.regressor.empty() && regressor)
    throw InputError(fmt::format(
        "a trained regressor goes with --method {} or hybrid, not with {}; choose one of these or leave out "
        "--database",
        trained_names(), name));
  if (method.regressor.empty()) return method;
  if (!regressor)
    throw InputError(
        fmt::format("--method {} needs what `conchoid forest train` has written: add --database FILE", name));
  if (regressor->name() != method.regressor)
    throw InputError(fmt::format(
        "--method {} needs a {}, but the database holds a {}; use --method {} or train another", name,
        regressor_kind(method.regressor).title, regressor_kind(regressor->name()).title, regressor->name()));
  return method;
}

OpeningSourceFor sources_by(const OpeningMethod& method, const RunSpec& run, const Regressor* regressor,
                            int solve_every, const std::optional<double>& tolerance) {
  return [&method, regressor, solve_every, tolerance,
          sif = sif_settings(run)](const PreparedBody& body) -> MakeOpeningSource {
    return [&method, regressor, solve_every, tolerance, sif, &body](BemOpening& bem) {
      return method.make({{bem, body.material, body, sif, solve_every, tolerance}, regressor});
    };
  };
}

}  // namespace conchoid
