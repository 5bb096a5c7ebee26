#pragma once

#include <filesystem>
#include <optional>
#include <vector>

#include "conchoid/mesh/tri_mesh.hpp"

namespace conchoid {

/// How finely an initial crack is meshed: by the number of triangles, met as nearly as its pattern allows, or
/// by the edge length along the front [m]. Exactly one of the two must be positive.
struct SheetResolution {
  int triangles = 0;
  double edge = 0;
};

// Open sheets for initial cracks. Triangles are counter-clockwise seen from the side the normal points to.
// Each has along its front a regular ring of triangles — front edges of equal length, one triangle behind
// each, about as high as its edge is long — because stress intensity factors are read there. None has a
// handedness: mirror images in the in-plane axes are the same mesh. `direction` fixes the first in-plane axis
// (it is projected into the plane); without it an axis is chosen from the coordinate axis nearest to the
// plane. All throw InputError for sizes that are not positive and finite, or a zero normal.

/// Disc of K concentric hexagonal rings, ring k with 6k nodes at radius k·R/K: 6K² triangles (384 for K = 8).
TriMesh disc_crack(const Vec3& center, const Vec3& normal, double radius, const SheetResolution& resolution,
                   const std::optional<Vec3>& direction = {});

/// Ellipse with semi-axes a (along `direction`) and b (across): rings around a middle segment of s edges,
/// ring k with 6k + 2s nodes evenly spaced along its own ellipse; 6K² + 4sK triangles. For a = b the same as
/// the disc.
TriMesh ellipse_crack(const Vec3& center, const Vec3& normal, double a, double b,
                      const SheetResolution& resolution, const std::optional<Vec3>& direction = {});

/// Rectangle center ± edge1/2 ± edge2/2, normal edge1 × edge2. n × m front edges (at least 3 each), behind
/// each a node straight below its middle; 2nm + 2(n+m) − 2 triangles for odd n and m, a few more otherwise.
/// All four sides are front.
TriMesh rectangle_crack(const Vec3& center, const Vec3& edge1, const Vec3& edge2,
                        const SheetResolution& resolution);

/// Makes a sheet that ends on the body's surface stick out of it: extrudes the given boundary edges by
/// `length` [m] outward in the planes of their triangles (direction averaged at shared nodes; there the strip
/// keeps its width), one strip of two triangles per edge. Nodes and triangles of the sheet keep their ids.
/// Throws InputError for edges that are not boundary edges of the sheet.
TriMesh extend_sheet_beyond(const TriMesh& sheet, const std::vector<Edge>& edges, double length);

/// Edges that only one triangle has, ascending.
std::vector<Edge> boundary_edges(const TriMesh& mesh);

}  // namespace conchoid
