#include "conchoid/surface/contacts.hpp"

#include <algorithm>
#include <boost/container/small_vector.hpp>
#include <map>
#include <span>
#include <utility>

#include "conchoid/core/parallel.hpp"
#include "conchoid/mesh/id_lists.hpp"

namespace conchoid {
namespace {

using Polygon = boost::container::small_vector<Vec2, 8>;

double cross2(const Vec2& a, const Vec2& b) {
  return a[0] * b[1] - a[1] * b[0];
}

double twice_area(const Polygon& p) {
  double sum = 0;
  for (std::size_t i = 1; i + 1 < p.size(); ++i)
    sum += cross2(p[i] - p[0], p[i + 1] - p[0]);
  return sum;
}

/// What lies to the left of a → b.
Polygon clipped(const Polygon& p, const Vec2& a, const Vec2& b) {
  Polygon out;
  for (std::size_t i = 0; i < p.size(); ++i) {
    const Vec2 &x = p[i], &y = p[(i + 1) % p.size()];
    const double sx = cross2(b - a, x - a), sy = cross2(b - a, y - a);
    if (sx >= 0) out.push_back(x);
    if ((sx > 0 && sy < 0) || (sx < 0 && sy > 0)) out.push_back(x + sx / (sx - sy) * (y - x));
  }
  return out;
}

/// A fracture face of a piece.
struct Face {
  std::size_t fragment;
  TriId triangle;
};

/// By triangle of the sheets: the fracture faces of all pieces.
IdLists<TriId, Face> faces_of_sheets(const std::vector<Fragment>& fragments) {
  const auto each = [&](const auto& put) {
    for (std::size_t f = 0; f < fragments.size(); ++f)
      for (std::size_t t = 0; t < fragments[f].mesh.triangle_count(); ++t)
        if (fragments[f].face_kind[t] == FaceKind::fracture) put(fragments[f].source[t], Face{f, TriId(t)});
  };
  std::size_t sources = 0;
  each([&](TriId source, const Face&) { sources = std::max(sources, source.index() + 1); });
  return IdLists<TriId, Face>(sources, each);
}

/// A fracture face with an area.
struct Tile {
  std::size_t fragment;
  Triangle corners;
  Vec3 area;
};

/// Contacts over one triangle of a sheet.
std::vector<FragmentContact> contacts_over(const std::vector<Fragment>& fragments,
                                           std::span<const Face> faces) {
  std::vector<Tile> tiles;
  for (const Face& face : faces) {
    const TriMesh& mesh = fragments[face.fragment].mesh;
    if (const Vec3 area = area_vector(mesh, face.triangle); !area.isZero(0))
      tiles.push_back({face.fragment, mesh.triangle(face.triangle), area});
  }
  std::vector<FragmentContact> contacts;
  if (tiles.empty()) return contacts;
  const Vec3 normal = std::max_element(tiles.begin(), tiles.end(), [](const Tile& x, const Tile& y) {
                        return x.area.squaredNorm() < y.area.squaredNorm();
                      })->area.normalized();
  for (const Tile& up : tiles)
    for (const Tile& down : tiles)
      if (up.fragment != down.fragment && up.area.dot(normal) > 0 && down.area.dot(normal) < 0)
        if (const double area = common_area(up.corners, down.corners, normal); area > 0) {
          const auto [first, second] = std::minmax(up.fragment, down.fragment);
          contacts.push_back({first, second, area});
        }
  return contacts;
}

}  // namespace

double common_area(const Triangle& a, const Triangle& b, const Vec3& normal) {
  Eigen::Index least = 0;
  normal.cwiseAbs().minCoeff(&least);
  const Vec3 u = cross(Vec3::Unit(least), normal).normalized(), v = cross(normal, u);
  const auto flat = [&](const Triangle& t) {
    Polygon p;
    for (const Vec3& x : t)
      p.emplace_back((x - a[0]).dot(u), (x - a[0]).dot(v));
    if (twice_area(p) < 0) std::reverse(p.begin(), p.end());
    return p;
  };
  Polygon common = flat(a);
  const Polygon frame = flat(b);
  for (std::size_t k = 0; k < 3 && !common.empty(); ++k)
    common = clipped(common, frame[k], frame[(k + 1) % 3]);
  return std::max(0.0, 0.5 * twice_area(common));
}

std::vector<FragmentContact> fragment_contacts(const std::vector<Fragment>& fragments) {
  constexpr std::size_t sources_of_task = 512;
  const IdLists<TriId, Face> faces = faces_of_sheets(fragments);
  const auto over = parallel_values(faces.size(), sources_of_task,
                                    [&](std::size_t s) { return contacts_over(fragments, faces[TriId(s)]); });
  std::map<std::pair<std::size_t, std::size_t>, double> shared;
  for (const auto& contacts : over)
    for (const FragmentContact& c : contacts)
      shared[{c.first, c.second}] += c.area;
  std::vector<FragmentContact> contacts;
  for (const auto& [pair, area] : shared)
    contacts.push_back({pair.first, pair.second, area});
  return contacts;
}

}  // namespace conchoid
