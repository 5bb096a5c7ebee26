#pragma once

#include <cstddef>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "conchoid/mesh/surface_parts.hpp"
#include "conchoid/remesh/validate.hpp"
#include "conchoid/remesh/wall_resolution.hpp"

namespace conchoid {

/// A hole: one loop of edges with a single triangle each.
struct Hole {
  std::size_t edges = 0;
  double length = 0;           ///< [m]
  Vec3 center = Vec3::Zero();  ///< mean of its nodes [m]
  NodeId first_node;           ///< the smallest id along it
};

/// Two triangles that meet where they must not.
struct Intersection {
  TriId s, t;
  Vec3 where = Vec3::Zero();  ///< mean of their corners [m]
};

/// What unit a file is probably in. Files do not say; numbers are read as metres.
struct UnitGuess {
  std::string unit;  ///< "m", "mm or cm", …
  double scale = 1;  ///< suggested body.scale
  std::string why;
};

/// Settings that would suit a mesh, in the unit of its file.
struct ResolutionAdvice {
  double crack =
      0;  ///< r̄: a tenth of the cube root of the volume, as a scene without it has, or less: half of the thinnest wall
  double surface = 0;  ///< mean edge of the file, between r̄ / 40 and r̄ / 5
  std::optional<std::size_t>
      remesh;  ///< body.remesh that gives boundary elements with edges of about a tenth of that root, shorter on thin walls
};

/// Everything `conchoid check` has to say about a surface.
struct SurfaceReport {
  std::size_t triangles = 0, nodes = 0;
  Box box{Vec3::Zero(), Vec3::Zero()};
  double area = 0;                                            ///< [m²]
  double volume = 0;                                          ///< with the holes filled [m³]
  double shortest_edge = 0, mean_edge = 0, longest_edge = 0;  ///< [m]
  double smallest_angle = 0;                                  ///< [rad]
  UnitGuess unit;
  std::vector<Hole> holes;
  std::vector<Intersection> intersections;  ///< the first ones, found also where the connectivity is broken
  bool more_intersections = false;          ///< there are more than are listed
  std::vector<SurfacePart> parts;
  std::size_t bodies = 0;  ///< parts that bound a volume from outside; a scene takes one
  std::map<DefectKind, std::size_t> defect_counts;  ///< each up to most_counted
  std::vector<MeshDefect> defects;          ///< empty: a scene can use the mesh as it is (find_defects)
  std::optional<ResolutionAdvice> advice;   ///< none where there is no volume
  std::optional<CoarseWalls> coarse_walls;  ///< of a usable mesh, taken for boundary elements as it is

  bool usable() const { return defects.empty(); }
};

/// Defects and intersections are counted up to this number of a kind.
inline constexpr std::size_t most_counted = 10000;

/// The longest extent decides: 0.01 to 20 is taken for metres, up to 500 for mm or cm, beyond that for mm,
/// from 5000 on for µm or mm.
UnitGuess guess_unit(double longest_extent);

/// Looks at a surface that may be bad in every way a file can be.
SurfaceReport examine(const TriMesh& mesh);

/// "open edges" …: the name of a kind of defect in the plural.
std::string name_of(DefectKind kind);

}  // namespace conchoid
