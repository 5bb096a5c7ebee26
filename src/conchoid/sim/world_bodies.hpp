#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "conchoid/core/random.hpp"
#include "conchoid/mesh/tri_mesh.hpp"

namespace conchoid {

/// A body drawn at random from its class, made of boundary elements.
struct RandomBody {
  TriMesh surface;            ///< closed, oriented outward, about a metre across
  Vec3 axis = Vec3::UnitZ();  ///< unit vector along which it is held and pulled
  double thickness = 0;       ///< of its thinnest part [m]
  bool hollow = false;        ///< has walls that look at the z axis
};

/// Classes of bodies:
///   box         any proportions between 0.4 and 1
///   plate       as a box, 0.1 to 0.22 thick
///   prism       over a random polygon of 3 to 8 corners
///   cylinder    solid, short or long
///   tube        a ring to a pipe, bore of 0.4 to 0.75 of its width
///   cup         a cup or vase: closed below, open above, its wall swelling
///   rod         twice to four times as long as wide, with a V-notch across its middle
///   blob        a ball with smooth bumps, drawn out
///   polyhedron  convex hull of random points
const std::vector<std::string_view>& body_class_names();

/// The class of bodies that are not made up: scans, drawn out and decimated.
inline constexpr std::string_view kScanClass = "scan";
/// The names above and that.
const std::vector<std::string_view>& world_class_names();

/// @param elements  wanted number of triangles, met within a factor of about 1.5
/// Throws InputError for an unknown class, with the known ones, and ComputationError where the body drawn
/// cannot be meshed.
RandomBody random_body(std::string_view body_class, int elements, Random& random);

/// A body as the class "scan" starts from it: its longest extent one metre, the middle of its box at the origin, and no more
/// than 20 triangles for each element wanted, or as many as its shape needs.
TriMesh scan_of(TriMesh body, int elements);
/// One of some scans, each of its extents drawn out by 0.8 to 1.25, with an axis of any direction, of so many elements or as many
/// as its shape needs. Throws ComputationError where it cannot be meshed.
RandomBody random_scan(const std::vector<TriMesh>& scans, int elements, Random& random);

}  // namespace conchoid
