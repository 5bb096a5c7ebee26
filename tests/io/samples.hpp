#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "conchoid/surface/fragments.hpp"
#include "temporary_folder.hpp"

namespace conchoid {

using test::file_content, test::TemporaryFolder;

/// Box with two triangles per face, oriented outward: 8 nodes, 12 triangles, the bottom (low z) first.
inline TriMesh box(const Vec3& low, const Vec3& high) {
  TriMesh m;
  for (int i = 0; i < 8; ++i)
    m.positions.add({(i & 1 ? high : low).x(), (i & 2 ? high : low).y(), (i & 4 ? high : low).z()});
  const int faces[6][4] = {{0, 2, 3, 1}, {4, 5, 7, 6}, {0, 1, 5, 4},
                           {2, 6, 7, 3}, {0, 4, 6, 2}, {1, 3, 7, 5}};
  for (const auto& f : faces) {
    m.corners.add({NodeId(f[0]), NodeId(f[1]), NodeId(f[2])});
    m.corners.add({NodeId(f[0]), NodeId(f[2]), NodeId(f[3])});
  }
  return m;
}

/// The unit cube around the origin broken at z = `height` into a lower and an upper box of density 1000
/// kg/m³.
inline std::vector<Fragment> broken_cube(double height) {
  std::vector<Fragment> pieces(2);
  for (int i = 0; i < 2; ++i) {
    Fragment& f = pieces[static_cast<std::size_t>(i)];
    f.mesh =
        i == 0 ? box({-0.5, -0.5, -0.5}, {0.5, 0.5, height}) : box({-0.5, -0.5, height}, {0.5, 0.5, 0.5});
    f.face_kind.assign(12, FaceKind::original);
    const std::size_t fracture = i == 0 ? 2 : 0;  // top of the lower box, bottom of the upper one
    f.face_kind[fracture] = f.face_kind[fracture + 1] = FaceKind::fracture;
    for (int t = 0; t < 12; ++t)
      f.source.push_back(TriId(t));
    f.volume = enclosed_volume(f.mesh);
    f.mass = 1000 * f.volume;
    f.center_of_mass = bounding_box(f.mesh).center();
    f.inertia = Vec3(1, 2, 3).asDiagonal();
    f.watertight = true;
  }
  return pieces;
}

/// Square sheet of side 1 around the origin at the given height, n × n × 2 triangles.
inline TriMesh sheet(int n, double height) {
  TriMesh m;
  for (int j = 0; j <= n; ++j)
    for (int i = 0; i <= n; ++i)
      m.positions.add({-0.5 + double(i) / n, -0.5 + double(j) / n, height});
  const auto id = [&](int i, int j) { return NodeId(j * (n + 1) + i); };
  for (int j = 0; j < n; ++j)
    for (int i = 0; i < n; ++i) {
      m.corners.add({id(i, j), id(i + 1, j), id(i + 1, j + 1)});
      m.corners.add({id(i, j), id(i + 1, j + 1), id(i, j + 1)});
    }
  return m;
}

}  // namespace conchoid
