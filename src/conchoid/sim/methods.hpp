#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "conchoid/learn/regressor.hpp"
#include "conchoid/sim/breakup.hpp"
#include "conchoid/sim/predicted_opening.hpp"

namespace conchoid {

/// What a source of opening is made from. All of it must outlive the source.
struct MethodContext {
  PredictionContext prediction;
  const Regressor* regressor = nullptr;
};

/// Where the opening of a run comes from after frame 1, as a user chooses it.
struct OpeningMethod {
  std::string name;       ///< as --method and in run.json
  std::string title;      ///< of a picture of such a run
  std::string help;       ///< half a sentence
  std::string regressor;  ///< kind of regressor (learn/regressor_kinds.hpp) that it needs; empty: none
  bool hybrid = false;    ///< takes a tolerance, and a regressor of any kind or none
  /// Predicts without training: `forest evaluate` reports it beside a regressor. May be null.
  const OpeningPredictor* baseline = nullptr;
  /// Null where the boundary elements of the context solve every frame.
  std::function<std::unique_ptr<OpeningSource>(const MethodContext&)> make;

  /// Kind of the regressors that come with the program (learn/shipped.hpp) that it takes; empty: none.
  std::string_view shipped_kind() const { return hybrid ? "network" : std::string_view(regressor); }
};

/// × the body's diagonal: the error of the surface that hybrid runs keep to where nothing else is said.
inline constexpr double kStandardTolerance = 0.005;

/// bem, steady, kept, stress, hybrid, and one for every kind of regressor.
const std::vector<OpeningMethod>& opening_methods();
/// Throws InputError that lists the known names.
const OpeningMethod& opening_method(std::string_view name);
/// Null if there is none of that name.
const OpeningMethod* find_opening_method(std::string_view name);
/// Those that predict without training.
std::vector<const OpeningPredictor*> baseline_predictors();

/// The method of that name, with what it needs. Throws InputError if the name is unknown, if a regressor is
/// missing, of another kind or not needed, or if there is a tolerance that the method does not know or that is
/// negative.
const OpeningMethod& checked_method(std::string_view name, const Regressor* regressor,
                                    const std::optional<double>& tolerance = {});

/// What makes the source of the opening of a run by a method, for its body and for the pieces that this breaks into.
/// @param method, regressor  must outlive the run; the latter null where the method needs none
/// @param solve_every, tolerance  as in PredictionContext
OpeningSourceFor sources_by(const OpeningMethod& method, const RunSpec& run, const Regressor* regressor,
                            int solve_every = 0, const std::optional<double>& tolerance = {});

}  // namespace conchoid
