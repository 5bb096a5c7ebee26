#pragma once

#include <optional>
#include <string>
#include <vector>

#include "conchoid/surface/fragment_attributes.hpp"

namespace conchoid {

class TomlTable;

/// [output] of a scene: what the pieces are written as, and how they look.
struct OutputSpec {
  std::vector<std::string> formats{"ply", "obj", "glb"};
  Projection projection = Projection::box;
  std::optional<double> texture_size;  ///< [m]; none: the body's size
  double crease_angle = 35;            ///< [°]
  double exaggeration = 0;             ///< of displacement and opening in frames/, 0: as they are
  std::string where;
};

OutputSpec read_output(const TomlTable& file);

}  // namespace conchoid
