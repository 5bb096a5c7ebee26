#include "conchoid/sim/mended_fragment.hpp"

#include <cmath>
#include <optional>

#include "conchoid/intersect/self_intersection.hpp"
#include "conchoid/mesh/carry_attributes.hpp"
#include "conchoid/mesh/closest_point.hpp"
#include "conchoid/mesh/id_lists.hpp"
#include "conchoid/remesh/editable_mesh.hpp"
#include "conchoid/remesh/flat_triangles.hpp"
#include "conchoid/remesh/mend.hpp"
#include "conchoid/remesh/patch_intersections.hpp"
#include "conchoid/remesh/tidy.hpp"
#include "conchoid/surface/mass_properties.hpp"

namespace conchoid {
namespace {

constexpr double kSliver = 0.01;  // height over longest edge
constexpr int kMostRings = 3;     // of triangles around a fold
constexpr int kMostPasses = 4;    // where what is made anew folds once more

bool is_solid(const TriMesh& mesh) {
  return is_watertight(mesh) && self_intersections(mesh, 1).empty();
}

bool has_folded_sliver(const TriMesh& mesh) {
  const NodeLists<TriId> around = triangles_at_nodes(mesh);
  for (std::size_t i = 0; i < mesh.triangle_count(); ++i) {
    const TriId sliver(i);
    if (flatness(mesh.triangle(sliver)) > kSliver) continue;
    for (const NodeId n : mesh.corners[sliver])
      for (const TriId t : around[n])
        if (t != sliver && triangles_intersect(mesh, sliver, t)) return true;
  }
  return false;
}

// Per triangle the one of another mesh that its middle is nearest to.
std::vector<TriId> nearest_faces(const TriMesh& of, const TriMesh& on) {
  const ClosestPointTree tree(on);
  std::vector<TriId> nearest;
  for (std::size_t t = 0; t < of.triangle_count(); ++t)
    nearest.push_back(tree.closest(centroid(of, TriId(t))).triangle);
  return nearest;
}

// The triangles around the folds made anew, as few as will do; else all that mending can do. A solid, without triangles
// that have no area if that can be had. None where it is fine, or as good as it can be made.
std::optional<TriMesh> mended_surface(const TriMesh& mesh, double most) {
  const bool solid = is_solid(mesh);
  if (solid && !has_flat_triangle(mesh)) return std::nullopt;
  const double volume = enclosed_volume(mesh);
  std::optional<TriMesh> with_flat_triangles;
  const auto is_same = [&](const TriMesh& tried) {
    return is_solid(tried) && std::abs(enclosed_volume(tried) - volume) <= most * std::abs(volume);
  };
  const auto good = [&](TriMesh& tried) {
    if (!is_same(tried)) return false;
    if (!has_flat_triangle(tried)) return true;
    TriMesh without = tried;
    remove_flat_triangles(without);
    if (!has_flat_triangle(without) && is_same(without)) {
      tried = std::move(without);
      return true;
    }
    if (!solid && !with_flat_triangles) with_flat_triangles = tried;
    return false;
  };
  for (int rings = 0; !solid && rings <= kMostRings; ++rings) {
    TriMesh tried = mesh;
    for (int pass = 0; pass < kMostPasses && patch_intersections(tried, rings) > 0; ++pass) {
      drop_unused_nodes(tried);
      if (good(tried)) return tried;
    }
  }
  if (TriMesh tried = mesh; solid && good(tried)) return tried;
  MendReport report;
  TriMesh tried = mended(mesh, report);
  return good(tried) ? std::optional(std::move(tried)) : std::move(with_flat_triangles);
}

// Whether it was changed.
bool mend_surface(Fragment& f, double most) {
  std::optional<TriMesh> mesh = mended_surface(f.mesh, most);
  if (!mesh) return false;
  std::vector<FaceKind> kind;
  std::vector<TriId> source;
  for (const TriId t : nearest_faces(*mesh, f.mesh)) {
    kind.push_back(f.face_kind[t.index()]);
    source.push_back(f.source[t.index()]);
  }
  f.attributes = carried_over({f.mesh, f.attributes}, *mesh);
  f.mesh = std::move(*mesh);
  f.face_kind = std::move(kind);
  f.source = std::move(source);
  f.watertight = true;
  return true;
}

// Likewise. The slits that part its faces in the piece can hide where they pass through each other.
bool mend_solid(UnfinishedCracks& cracks, double most) {
  if (cracks.solid.corners.empty()) return false;
  std::optional<TriMesh> solid = mended_surface(cracks.solid, most);
  if (solid) cracks.solid = std::move(*solid);
  return solid.has_value();
}

}  // namespace

bool is_solid(const Fragment& fragment) {
  return is_solid(fragment.mesh);
}

void mend_fragment(Fragment& f, double most) {
  const bool surface = mend_surface(f, most), solid = mend_solid(f.unfinished, most);
  if ((surface || solid) && !f.unfinished.solid.corners.empty())
    f.unfinished.solid_face = nearest_faces(f.unfinished.solid, f.mesh);
}

void mend_folded_slivers(Fragment& f) {
  if (has_folded_sliver(f.mesh)) mend_fragment(f);
}

}  // namespace conchoid
