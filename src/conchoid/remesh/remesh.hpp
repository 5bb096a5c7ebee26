#pragma once

#include <cstddef>
#include <limits>

#include "conchoid/core/error.hpp"
#include "conchoid/mesh/tri_mesh.hpp"
#include "conchoid/remesh/local_edges.hpp"

namespace conchoid {

/// What came out of `remesh`.
struct RemeshReport {
  int triangles = 0;
  double smallest_angle = 0;  ///< [degrees]
  int below_15_degrees = 0;   ///< triangles with a smaller angle than 15°
  double hausdorff_distance =
      0;  ///< [m] largest distance between the surfaces, both ways, at nodes, edge middles and centroids
};

/// A shape that cannot be met by as many triangles as were asked for.
class TriangleCountError : public ComputationError {
 public:
  TriangleCountError(int asked, std::size_t allowed);
  /// As many as came about.
  std::size_t allowed() const { return allowed_; }

 private:
  std::size_t allowed_;
};

/// Whether so many triangles are what was asked for: within 10 %.
bool remesh_meets(int target_triangles, std::size_t triangles);

/// A closed surface as about `target_triangles` (within 10 % where the shape allows) well-shaped triangles
/// for boundary elements: closed, manifold, oriented as the original, free of self-intersections, near the
/// original. Edges sharper than 40° are kept as edges where they form lines longer than two triangles. First
/// decimation by edge collapses (quadric errors, Garland & Heckbert 1997), then isotropic remeshing by
/// splits, collapses, flips and tangential smoothing back on the original (Botsch & Kobbelt 2004); every step
/// is refused that would break the manifold, fold the surface or make it intersect itself. Same input, same
/// bits; scaling by a power of two scales the result exactly. `detailed` must be a valid body (validate.hpp).
/// Throws InputError for fewer than 20 triangles asked for and TriangleCountError if the target cannot be met
/// within 10 %.
TriMesh remesh(const TriMesh& detailed, int target_triangles, RemeshReport* report = nullptr);
/// The same with edges that follow the thickness of walls, or limits. Without any of these to obey: the same bits.
TriMesh remesh(const TriMesh& detailed, int target_triangles, const RemeshSettings& settings,
               RemeshReport* report = nullptr);

/// As about as many triangles as wanted, or as a shape of limbs and folds needs: asks for more in a few steps, as what a shape
/// allows grows with what it is asked for. Throws TriangleCountError where that does not do or `most` would not.
TriMesh remesh_or_more(const TriMesh& detailed, int wanted, int most = std::numeric_limits<int>::max());

/// Largest distance of nodes, edge middles and centroids of each mesh from the other [m].
double sampled_hausdorff_distance(const TriMesh& a, const TriMesh& b);

}  // namespace conchoid
