#pragma once

#include <optional>
#include <string>
#include <vector>

#include "conchoid/mesh/regions.hpp"
#include "conchoid/mesh/surface_attributes.hpp"

namespace conchoid {

/// The points x with normal·x > offset; the normal need not be a unit vector.
struct HalfSpace {
  Vec3 normal = Vec3::Zero();
  double offset = 0;  ///< [m] when the normal is a unit vector

  bool contains(const Vec3& x) const { return normal.dot(x) > offset; }
};

/// A ball, or with an axis an endless cylinder.
struct RoundBody {
  Vec3 center = Vec3::Zero();     ///< [m]
  double radius = 0;              ///< [m]
  std::optional<Vec3> axis = {};  ///< unit vector

  /// Of x from the body [m]; below 0 inside.
  double distance(const Vec3& x) const;
};

/// What a scene says about one region: a triangle is wanted when its three vertices lie strictly in all half spaces,
/// in the box, in the ball and within reach of the indenter, it is of the material and in the group, and no other such
/// triangle is nearer to the point. What is not given asks for nothing.
struct RegionRule {
  std::string name;
  std::vector<HalfSpace> half_spaces = {};
  std::optional<Box> box = {};
  std::optional<RoundBody> ball = {};      ///< without an axis
  std::optional<RoundBody> indenter = {};  ///< what is pressed on, where it stands
  double reach = 0;                        ///< from the indenter's surface [m]
  std::string material = {};               ///< of the surface's attributes; empty: any
  std::string group = {};                  ///< of the surface's attributes; empty: any
  std::optional<Vec3> nearest = {};        ///< [m]

  /// Whether x lies where the rule asks for, as far as it asks for a place.
  bool holds(const Vec3& x) const;
};

/// One region per rule, in their order: a triangle belongs to the first rule that wants it. Triangles that no rule
/// wants are in no region; a rule that gets no triangle yields an empty region.
/// @param attributes  of the mesh: its materials and groups; without them no triangle is of any
std::vector<Region> select_regions(const TriMesh& mesh, const std::vector<RegionRule>& rules,
                                   const SurfaceAttributes& attributes = {});

}  // namespace conchoid
