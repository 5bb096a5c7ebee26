#pragma once

#include <array>
#include <string>
#include <vector>

#include "conchoid/mesh/tri_mesh.hpp"

namespace conchoid {

/// What a file says about a surface besides its shape. Values belong to the corners of triangles, not to
/// nodes, so that both sides of a seam keep their own. Every list is empty (the surface has none) or as long
/// as the mesh has triangles.
struct SurfaceAttributes {
  std::vector<std::array<Vec3, 3>> normal;  ///< unit vectors; zero at a corner without one
  std::vector<std::array<Vec2, 3>> uv;      ///< texture coordinates, v upward; zero at a corner without
  std::vector<int> material;                ///< per triangle: index into `materials`
  std::vector<std::string> materials;
  std::vector<int> group;           ///< per triangle: index into `groups`
  std::vector<std::string> groups;  ///< names of the groups that a triangle is in, spaces between them

  bool empty() const { return normal.empty() && uv.empty() && material.empty() && group.empty(); }
};

/// Whether a list of names with spaces between them holds this one.
bool is_among(const std::string& names, const std::string& name);

struct AttributedMesh {
  TriMesh mesh;
  SurfaceAttributes attributes;
};

/// Weights w ≥ 0, Σw = 1, of the point of a triangle nearest to x in its plane (x lies on the triangle, up to
/// round-off). Where x is one of the corners, bit for bit, the weights are exactly 1, 0, 0.
Vec3 barycentric_weights(const Triangle& triangle, const Vec3& x);

/// Collects attributes while a file is read, where single corners or faces may go without.
class AttributeCollector {
 public:
  /// Names of materials get their numbers in the order of their first triangle.
  void use_material(const std::string& name);
  /// Names with spaces between them; the triangles that follow are in all of these groups.
  void use_groups(const std::string& names);
  void add_normal(std::size_t triangle, int corner, const Vec3& normal);
  void add_uv(std::size_t triangle, int corner, const Vec2& uv);
  bool has_normal() const { return !out_.normal.empty(); }
  bool has_uv() const { return !out_.uv.empty(); }
  /// The current material and groups belong to the triangle.
  void add_triangle(std::size_t triangle);
  /// @param triangles  how many the mesh has
  SurfaceAttributes finish(std::size_t triangles);

 private:
  SurfaceAttributes out_;
  std::string material_, groups_;  // current ones; empty: none was named yet
};

}  // namespace conchoid
