#include "conchoid/remesh/repair.hpp"

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "conchoid/core/error.hpp"
#include "conchoid/core/numbers.hpp"
#include "conchoid/core/parallel.hpp"
#include "conchoid/core/progress.hpp"
#include "conchoid/mesh/closest_point.hpp"
#include "conchoid/mesh/surface_parts.hpp"
#include "conchoid/remesh/decimate.hpp"
#include "conchoid/remesh/editable_mesh.hpp"
#include "conchoid/remesh/fill_holes.hpp"
#include "conchoid/remesh/validate.hpp"
#include "conchoid/remesh/voxel_surface.hpp"

namespace conchoid {
namespace {

constexpr double most_lattice_points = 600.0 * 600.0 * 600.0;

/// Largest distance of a node of `from` from the surface `to` [m].
double farthest_node(const TriMesh& from, const TriMesh& to) {
  const ClosestPointTree tree(to);
  std::vector<double> squared(from.node_count());
  parallel_for(from.node_count(), 256, [&](std::size_t begin, std::size_t end) {
    for (std::size_t n = begin; n < end; ++n)
      squared[n] = tree.closest(from.positions[NodeId(n)]).squared_distance;
  });
  return squared.empty() ? 0 : std::sqrt(*std::max_element(squared.begin(), squared.end()));
}

/// Parts smaller than a voxel are where the surface just touches a lattice point.
std::size_t drop_specks(TriMesh& mesh, double voxel) {
  std::vector<TriId> kept;
  std::size_t dropped = 0;
  for (const SurfacePart& part : surface_parts(mesh)) {
    if (std::abs(part.volume) < voxel * voxel * voxel)
      ++dropped;
    else
      kept.insert(kept.end(), part.triangles.begin(), part.triangles.end());
  }
  if (dropped == 0) return 0;
  std::sort(kept.begin(), kept.end());
  mesh = submesh(mesh, kept);
  return dropped;
}

void require_lattice_that_fits(const Box& box, double voxel) {
  const std::array<std::size_t, 3> size = lattice_size(box, voxel);
  const double points =
      static_cast<double>(size[0]) * static_cast<double>(size[1]) * static_cast<double>(size[2]);
  if (points > most_lattice_points)
    throw InputError("a voxel of " + shortest(voxel) + " m would take " + std::to_string(size[0]) + " × " +
                     std::to_string(size[1]) + " × " + std::to_string(size[2]) +
                     " lattice points, more than 600³; use a larger voxel");
}

TriMesh simplified(const TriMesh& fine, const TriMesh& shape, double voxel) {
  constexpr double tolerance = 1.0 / 50, longest_edge = 32, cell = 4;  // in voxels
  EditableMesh mesh(fine, cell * voxel);
  simplify(mesh, shape, tolerance * voxel, longest_edge * voxel);
  return mesh.compact();
}

void repair_by_level_set(const TriMesh& tidy, double voxel, Repair& repair) {
  const std::vector<BoundaryLoop> loops = boundary_loops(tidy);
  const TriMesh closed = holes_filled(tidy, loops);
  require_lattice_that_fits(bounding_box(closed), voxel);
  Progress progress("steps of the level set", 4);
  const InsideLattice lattice = inside_lattice(closed, voxel);
  progress.advance();
  repair.method = RepairMethod::level_set;
  repair.voxel = voxel;
  repair.lattice = lattice.size;
  repair.filled_holes = loops.size();
  repair.mesh = lattice_boundary(lattice, closed);
  progress.advance();
  repair.dropped_specks = drop_specks(repair.mesh, voxel);
  repair.lattice_triangles = repair.mesh.triangle_count();
  if (repair.mesh.corners.empty())
    throw ComputationError("the surface bounds no volume that a voxel of " + shortest(voxel) +
                           " m could see; use a smaller voxel, or give the surface a thickness");
  repair.mesh = simplified(repair.mesh, closed, voxel);
  progress.advance();
  repair.volume_before = enclosed_volume(closed);
  repair.moved = farthest_node(repair.mesh, closed);
  repair.lost = farthest_node(tidy, repair.mesh);
  progress.advance();
}

}  // namespace

RepairMethod needed_repair(const TriMesh& mesh) {
  if (find_defects(mesh, 1).empty()) return RepairMethod::none;
  TidyReport tidying;
  if (find_defects(tidied(mesh, tidying), 1).empty()) return RepairMethod::tidying;
  MendReport mending;
  return find_defects(mended(mesh, mending), 1).empty() ? RepairMethod::mending : RepairMethod::level_set;
}

double default_voxel(const TriMesh& mesh) {
  const Box box = bounding_box(mesh);
  return (box.high - box.low).maxCoeff() / 200;
}

Repair repaired(const TriMesh& mesh, double voxel) {
  if (mesh.corners.empty())
    throw InputError("there are no triangles to repair; export a triangulated surface");
  Repair repair;
  repair.mesh = mesh;
  if (find_defects(mesh, 1).empty()) {
    repair.volume_before = repair.volume_after = enclosed_volume(mesh);
    return repair;
  }
  if (!(default_voxel(mesh) > 0))
    throw InputError("all triangles lie in one point; there is no surface to repair");
  const TriMesh tidy = tidied(mesh, repair.tidying);
  if (tidy.corners.empty()) throw ComputationError("no triangle has an area; there is no surface to repair");
  repair.mesh = tidy;
  repair.method = RepairMethod::tidying;
  repair.volume_before = enclosed_volume(holes_filled(tidy, boundary_loops(tidy)));
  if (!find_defects(repair.mesh, 1).empty()) {
    if (voxel == 0) repair.mesh = mended(mesh, repair.mending);
    repair.method = RepairMethod::mending;
    if (voxel != 0 || !find_defects(repair.mesh, 1).empty()) {
      if (voxel == 0) voxel = default_voxel(mesh);
      repair.mending = {};
      repair_by_level_set(tidy, voxel, repair);
      const std::vector<MeshDefect> left = find_defects(repair.mesh, 1);
      if (!left.empty())
        throw ComputationError("the repaired surface still has a defect (" + left.front().what +
                               "); try another voxel");
    }
  }
  repair.volume_after = enclosed_volume(repair.mesh);
  return repair;
}

}  // namespace conchoid
