#include "conchoid/sim/unfinished_cracks.hpp"

#include <algorithm>
#include <cmath>

#include "conchoid/core/error.hpp"
#include "conchoid/core/parallel.hpp"
#include "conchoid/crack/front/front.hpp"
#include "conchoid/intersect/corefine.hpp"
#include "conchoid/intersect/manifold_part.hpp"
#include "conchoid/mesh/closest_point.hpp"
#include "conchoid/mesh/surface_parts.hpp"
#include "conchoid/mesh/winding_number.hpp"

namespace conchoid {
namespace {

constexpr double kAlongFace = 0.8;  // cosine between the normals of a sheet and of a face it runs along …
constexpr double kNearFace = 0.9;   // … × r̄: and how near to it
constexpr double kLeastArea = 1;    // × r̄²: of what goes on
// × r̄: how deep that goes, below the faces that cut the piece free (what lies nearer is a shaving of what has come
// apart) and below any (what lies nearer no element resolves).
constexpr double kLeastDepth = 1;
constexpr double kLeastCover = 0.5;
constexpr double kLift = 0.15;  // × r̄: to which it leaves such a face
constexpr double kApart = 0.1;  // × r̄: what touched at a point only

// The faces that cut the piece free, as a mesh; without triangles if there are none.
TriMesh cut_faces(const Fragment& piece, const TriMesh& solid) {
  std::vector<TriId> faces;
  for (std::size_t t = 0; t < solid.triangle_count(); ++t) {
    const std::size_t of_mesh =
        piece.unfinished.solid_face.empty() ? t : piece.unfinished.solid_face[t].index();
    if (piece.face_kind[of_mesh] == FaceKind::fracture) faces.emplace_back(t);
  }
  return submesh(solid, faces);
}

// A sheet as it goes on in the piece.
class SheetInPiece {
 public:
  SheetInPiece(const CrackSheet& sheet, const Fragment& piece, const TriMesh& solid, double crack_edge,
               double stands_for)
      : mesh_(sheet.mesh),
        solid_(solid),
        faces_(cut_faces(piece, solid)),
        tree_(faces_),
        crack_edge_(crack_edge),
        stands_for_(stands_for) {
    IdVector<NodeId, Vec3> normals(mesh_.node_count(), Vec3::Zero());
    for (std::size_t t = 0; t < mesh_.triangle_count(); ++t)
      for (const NodeId n : mesh_.corners[TriId(t)])
        normals[n] += area_vector(mesh_, TriId(t));
    along_.assign(mesh_.node_count(), 0);
    deep_.assign(mesh_.node_count(), 0);
    parallel_for(mesh_.node_count(), 1, [&](std::size_t begin, std::size_t end) {
      for (std::size_t i = begin; i < end; ++i) {
        const NodeId n(i);
        along_[n] = lies_along(mesh_.positions[n], normals[n]);
        deep_[n] = !along_[n] && winding_number(solid_, mesh_.positions[n]) > 0.5;
      }
    });
  }

  // Triangles that reach into the material, and those around them; where they would lie in a face along which the
  // piece came off they leave the material instead.
  TriMesh part() {
    std::vector<TriId> kept;
    for (std::size_t t = 0; t < mesh_.triangle_count(); ++t)
      if (reaches_in(TriId(t))) kept.emplace_back(t);
    TriMesh moved = mesh_;
    for (std::size_t i = 0; i < mesh_.node_count(); ++i)
      if (along_[NodeId(i)]) moved.positions[NodeId(i)] = lifted(mesh_.positions[NodeId(i)]);
    return submesh(moved, kept);
  }

 private:
  bool lies_along(const Vec3& x, const Vec3& normal) const {
    if (faces_.corners.empty()) return false;
    const auto hit = tree_.closest(x);
    if (hit.squared_distance < stands_for_ * stands_for_) return true;
    const double near = kNearFace * crack_edge_;
    return hit.squared_distance < near * near &&
           std::abs(unit_normal(faces_, hit.triangle).dot(normal)) >= kAlongFace * normal.norm();
  }

  // A node in the material, or a triangle across a corner of it.
  bool reaches_in(TriId t) const {
    const auto& c = mesh_.corners[t];
    if (std::any_of(c.begin(), c.end(), [&](NodeId n) { return deep_[n]; })) return true;
    return std::none_of(c.begin(), c.end(), [&](NodeId n) { return along_[n]; }) &&
           winding_number(solid_, centroid(mesh_, t)) > 0.5;
  }

  // Over the face, beyond where it begins.
  Vec3 lifted(const Vec3& x) const {
    const auto hit = tree_.closest(x);
    const Vec3 n = unit_normal(faces_, hit.triangle);
    Vec3 beyond = hit.point - x;
    beyond -= beyond.dot(n) * n;
    if (const double length = beyond.norm(); length > kLift * crack_edge_)
      beyond /= length;
    else
      beyond.setZero();
    return hit.point + kLift * crack_edge_ * (n + beyond);
  }

  const TriMesh& mesh_;
  const TriMesh& solid_;
  TriMesh faces_;
  ClosestPointTree tree_;
  double crack_edge_, stands_for_;
  IdVector<NodeId, char> along_, deep_;
};

// Whether it goes on in the piece by more than a crumb of what has come apart.
// @param faces  that cut the piece free
bool goes_on_inside(const TriMesh& solid, const TriMesh& faces, const TriMesh& sheet, double crack_edge) {
  const CutComplex cut = corefine(solid, sheet);
  const TriMesh inside{cut.positions, cut.sheet};
  if (!(surface_area(inside) > kLeastArea * crack_edge * crack_edge)) return false;
  const ClosestPointTree surface(solid), parted(faces);
  const auto beyond = [](const ClosestPointTree& tree, const Vec3& x, double depth) {
    return tree.closest(x).squared_distance >= depth * depth;
  };
  const auto deep = [&](NodeId n) {
    const Vec3& x = inside.positions[n];
    return beyond(surface, x, kLeastCover * crack_edge) &&
           (faces.corners.empty() || beyond(parted, x, kLeastDepth * crack_edge));
  };
  const std::vector<Front> fronts = find_fronts(inside, cut.mouth);
  return std::any_of(fronts.begin(), fronts.end(), [&](const Front& front) {
    return std::any_of(front.nodes.begin(), front.nodes.end(), deep);
  });
}

}  // namespace

GoingOn unfinished_cracks(const CrackSheet& sheet, const Fragment& piece, double crack_edge,
                          double stands_for) {
  if (piece.unfinished.solid.corners.empty()) return {};  // no slit: nothing ends in it
  const TriMesh& solid = piece.unfinished.solid;
  const TriMesh faces = cut_faces(piece, solid);
  const TriMesh kept = split_fans(
      embedded_part(SheetInPiece(sheet, piece, solid, crack_edge, stands_for).part()), kApart * crack_edge);
  GoingOn out;
  for (const SurfacePart& part : surface_parts(kept)) {
    TriMesh one = submesh(kept, part.triangles);
    try {
      if (goes_on_inside(solid, faces, one, crack_edge)) out.sheets.push_back(std::move(one));
    } catch (const ComputationError&) {
      ++out.unclear;
    }
  }
  return out;
}

}  // namespace conchoid
