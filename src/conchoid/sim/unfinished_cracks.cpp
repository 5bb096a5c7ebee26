#include "conchoid/sim/unfinished_cracks.hpp"

#include <algorithm>
#include <cmath>

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
constexpr double kNearFace = 0.5;   // … × r̄: and how near to it

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

// Sheet triangles that do not lie along those faces.
std::vector<char> apart_from(const TriMesh& faces, const TriMesh& sheet, double crack_edge) {
  std::vector<char> apart(sheet.triangle_count(), 1);
  if (faces.corners.empty()) return apart;
  const ClosestPointTree tree(faces);
  for (std::size_t t = 0; t < apart.size(); ++t) {
    const auto hit = tree.closest(centroid(sheet, TriId(t)));
    const double near = kNearFace * crack_edge;
    const double cosine = unit_normal(faces, hit.triangle).dot(unit_normal(sheet, TriId(t)));
    apart[t] = hit.squared_distance > near * near || std::abs(cosine) < kAlongFace;
  }
  return apart;
}

// Triangles inside of the piece and those around them that stick out.
std::vector<TriId> in_and_around(const TriMesh& sheet, const TriMesh& solid, const std::vector<char>& apart) {
  std::vector<char> within(sheet.triangle_count(), 0);
  parallel_for(within.size(), 1, [&](std::size_t begin, std::size_t end) {
    for (std::size_t t = begin; t < end; ++t)
      within[t] = apart[t] && winding_number(solid, centroid(sheet, TriId(t))) > 0.5;
  });
  IdVector<NodeId, char> inside(sheet.node_count(), 0);
  for (std::size_t t = 0; t < sheet.triangle_count(); ++t)
    if (within[t])
      for (const NodeId n : sheet.corners[TriId(t)])
        inside[n] = 1;
  std::vector<TriId> kept;
  for (std::size_t t = 0; t < sheet.triangle_count(); ++t) {
    const auto& c = sheet.corners[TriId(t)];
    if (apart[t] && std::any_of(c.begin(), c.end(), [&](NodeId n) { return inside[n]; }))
      kept.emplace_back(t);
  }
  return kept;
}

bool has_front_inside(const TriMesh& solid, const TriMesh& sheet) {
  const CutComplex cut = corefine(solid, sheet);
  return !cut.sheet.empty() && !find_fronts({cut.positions, cut.sheet}, cut.mouth).empty();
}

}  // namespace

std::vector<TriMesh> unfinished_cracks(const CrackSheet& sheet, const Fragment& piece, double crack_edge) {
  if (piece.unfinished.solid.corners.empty()) return {};  // no slit: nothing ends in it
  const TriMesh& solid = piece.unfinished.solid;
  const std::vector<char> apart = apart_from(cut_faces(piece, solid), sheet.mesh, crack_edge);
  const TriMesh kept = embedded_part(submesh(sheet.mesh, in_and_around(sheet.mesh, solid, apart)));
  std::vector<TriMesh> out;
  for (const SurfacePart& part : surface_parts(kept)) {
    TriMesh one = submesh(kept, part.triangles);
    if (has_front_inside(solid, one)) out.push_back(std::move(one));
  }
  return out;
}

}  // namespace conchoid
