#pragma once

#include <functional>
#include <optional>
#include <vector>

#include "conchoid/remesh/size_field.hpp"

namespace conchoid {

/// Edges of at most this length where `holds` says so.
struct EdgeLimit {
  std::function<bool(const Vec3&)> holds;
  double edge = 0;  ///< [m]
};

/// What remeshing is to do beside meeting a number of triangles.
struct RemeshSettings {
  /// Elements no longer than what shows nine tenths of the bending stress in a wall (wall_resolution.hpp), as far
  /// as the number of triangles lasts: what is stout gets edges of up to twice the mean for it, no more.
  bool follow_thickness = false;
  std::vector<EdgeLimit> limits;  ///< kept whatever it costs elsewhere

  bool any() const { return follow_thickness || !limits.empty(); }
};

/// A size field, and the edge that its value 1 stands for [m].
struct LocalEdges {
  SizeField field;
  double edge;
};

/// What the settings ask for as sizes, so that edges of the field take `target` triangles. None where there is nothing to do: walls
/// thinner than their elements are less than 5 % of the surface, and no limit is below what the edges are anyway.
/// @param plain  without them, of the same surface; its value 1 stands for `edge`
/// Throws InputError where the limits alone take more than `target`.
std::optional<LocalEdges> local_edges(const SizeField& plain, double edge, std::size_t target,
                                      const RemeshSettings& settings);

}  // namespace conchoid
