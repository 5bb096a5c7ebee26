#pragma once

#include <string>

#include "conchoid/sim/run.hpp"
#include "scenes.hpp"

namespace conchoid::test {

/// A whole run of a scene as the user writes it, without a word on the way.
inline RunResult run_text(const std::string& text, RunOptions options = {}) {
  options.progress = false;
  return run_scene(scene_from_text(text), options);
}

}  // namespace conchoid::test
