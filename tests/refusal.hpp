#pragma once

#include <string>

#include "conchoid/core/error.hpp"

namespace conchoid::test {

/// What the InputError says that the action throws; "accepted" if it throws none.
template <class Action>
std::string refusal(const Action& action) {
  try {
    action();
  } catch (const InputError& error) {
    return error.what();
  }
  return "accepted";
}

}  // namespace conchoid::test
