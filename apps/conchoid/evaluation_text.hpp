#pragma once

#include <string>

#include "conchoid/learn/evaluate.hpp"

namespace conchoid {

/// One-step accuracy of a regressor beside its baselines, for a person.
std::string one_step_text(const Evaluation& evaluation);

}  // namespace conchoid
