#pragma once

#include <vector>

#include "conchoid/mesh/box_tree.hpp"

namespace conchoid {

/// How thick a body is beneath its surface: the distance along the inward normal to the opposite wall. Seven rays, the
/// normal and six at 20° around it, are sent in; of their depths along the normal the median counts, so that a single
/// one that meets a rib, a needle or nothing changes nothing (after the shape diameter of Shapira et al. 2008). A ray
/// counts where it leaves the body through a face whose normal is within 60° of its own direction: the faces beside an
/// edge are no walls of each other.
class WallProbe {
 public:
  /// @param body  closed, oriented outward
  explicit WallProbe(const TriMesh& body);

  /// @param x       on the surface [m]
  /// @param normal  there: outward, a unit vector
  /// @param reach   thicker walls need no measuring [m]
  /// @return thickness [m]; +∞ if it is more than `reach`, or if there is no opposite wall
  double thickness(const Vec3& x, const Vec3& normal, double reach) const;

  /// Of each triangle, from its centroid. +∞ for triangles without a normal.
  /// @param reach  per triangle [m]; 0: not measured, +∞
  IdVector<TriId, double> thickness(const IdVector<TriId, double>& reach) const;

 private:
  TriMesh body_;
  BoxTree tree_;
};

/// The same at a single place, for which no tree is made.
double wall_thickness(const TriMesh& body, const Vec3& x, const Vec3& normal, double reach);

/// Root of the mean square of the three edges of a triangle [m]: the length in which the error of linear functions
/// goes, and the edge of an equilateral triangle.
double mean_square_edge(const Triangle& triangle);

}  // namespace conchoid
