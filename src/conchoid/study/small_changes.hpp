#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "conchoid/sim/make_runs.hpp"

namespace conchoid {

/// A change of a scene that does not make it another one. How far the solved fracture moves with it is the noise below
/// which nobody can tell a prediction from a solution.
struct SmallChange {
  std::string title;
  std::function<std::optional<PreparedRun>(const PreparedRun&)>
      change;  ///< none where there is nothing to change
};

/// The same scene under `factor` times its load, pressures and moments included.
PreparedRun with_load(const PreparedRun& run, double factor);

/// The load larger by 0.5 %; turned by 0.5°, all of it about one axis across its first part; r̄ longer by a tenth; a
/// tenth more boundary elements, where the scene names the body, so that it can be meshed anew.
const std::vector<SmallChange>& small_changes();

}  // namespace conchoid
