#include "conchoid/sim/piece_scene.hpp"

#include <algorithm>
#include <cmath>

#include "conchoid/bem/body_force.hpp"
#include "conchoid/core/error.hpp"
#include "conchoid/mesh/closest_point.hpp"
#include "conchoid/remesh/remesh.hpp"
#include "conchoid/sim/spread_force.hpp"

namespace conchoid {
namespace {

constexpr int kFewestElements = 120;    // of a piece, however small: as the built-in cube
constexpr int kMostElements = 200000;   // that remesh() takes
constexpr double kMostForItsArea = 16;  // × the elements wanted, for a piece of limbs and folds

TriMesh elements_of(const TriMesh& piece, double element_area) {
  const double wanted = std::max<double>(kFewestElements, surface_area(piece) / element_area);
  const auto elements = [&](double share) {
    return static_cast<int>(std::min<double>(std::round(share * wanted), kMostElements));
  };
  return remesh_or_more(piece, elements(1), elements(kMostForItsArea));
}

// Which region of the body the elements of the piece belong to; −1: none.
class RegionTransfer {
 public:
  RegionTransfer(const PreparedBody& body, const Fragment& fragment, const TriMesh& piece)
      : body_(body),
        fragment_(fragment),
        region_(region_of_triangles(body.surface, body.regions)),
        same_mesh_(body.same_mesh()),
        faces_(piece),
        elements_(body.surface) {}

  int of_element(const Vec3& x) const {
    const std::size_t on = faces_.closest(x).triangle.index();
    const UnfinishedCracks& cracks = fragment_.unfinished;
    const std::size_t face = cracks.solid_face.empty() ? on : cracks.solid_face[on].index();
    if (fragment_.face_kind[face] == FaceKind::fracture) return -1;
    return region_[same_mesh_ ? fragment_.source[face] : elements_.closest(x - body_.origin).triangle];
  }

 private:
  const PreparedBody& body_;
  const Fragment& fragment_;
  IdVector<TriId, int> region_;
  bool same_mesh_;
  ClosestPointTree faces_, elements_;
};

std::vector<Region> regions_of_piece(const PreparedBody& body, const Fragment& fragment, const Body& piece) {
  std::vector<Region> regions;
  for (const Region& r : body.regions)
    regions.push_back({r.name, {}});
  const RegionTransfer transfer(body, fragment, piece.detailed);
  for (std::size_t t = 0; t < piece.surface.triangle_count(); ++t)
    if (const int r = transfer.of_element(centroid(piece.surface, TriId(t))); r >= 0)
      regions[static_cast<std::size_t>(r)].triangles.emplace_back(t);
  std::erase_if(regions, [](const Region& r) { return r.triangles.empty(); });
  return regions;
}

}  // namespace

PieceScene scene_of_piece(const Scene& scene, const PreparedBody& body, const Fragment& fragment) {
  PieceScene out{body_from_fragment(fragment, body.pieces), scene};
  out.body.surface = elements_of(
      out.body.detailed, surface_area(body.surface) / static_cast<double>(body.surface.triangle_count()));
  out.body.regions = regions_of_piece(body, fragment, out.body);
  out.scene.regions.clear();
  out.scene.cracks.clear();
  out.scene.boundary.clear();
  for (BoundaryCondition condition : scene.boundary) {
    if (!find_region(out.body.regions, condition.region)) continue;
    if (condition.load().kind == ConditionKind::force) {
      const LinearTraction spread =
          spread_force(body.surface, *find_region(body.regions, condition.region), condition);
      const bool beside = condition.kind == ConditionKind::displacement;
      (beside ? condition.free_kind : condition.kind) = ConditionKind::traction;
      (beside ? condition.free_value : condition.value) = spread.traction;
      condition.twist = spread.twist;
      condition.about = spread.about + body.origin;
    }
    out.scene.boundary.push_back(condition);
  }
  if (BodyForceSpec& force = out.scene.body_force; !force.on_axis)
    force.on_axis = volume_moments(body.surface).center + body.origin;
  out.scene.resolution = {body.crack_edge, body.surface_edge};
  out.scene.run.inertia_relief = true;
  if (!body.quadratic) out.scene.run.elements = ElementOrder::linear;
  out.scene.run.cache.reset();  // no other run has the same piece
  return out;
}

bool is_loaded(const Scene& scene) {
  const BoundaryCondition* held = nullptr;
  bool moved = false, alike = true;
  for (const BoundaryCondition& c : scene.boundary) {
    if (c.is_loaded()) return true;
    if (c.kind != ConditionKind::displacement) continue;
    moved = moved || !c.value.isZero(0);
    alike = alike && (!held || (held->value == c.value && held->held == c.held && held->axes == c.axes));
    held = &c;
  }
  if (!scene.body_force.spin.isZero(0)) return true;
  return (moved && !alike) || (held && !scene.body_force.gravity.isZero(0));
}

}  // namespace conchoid
