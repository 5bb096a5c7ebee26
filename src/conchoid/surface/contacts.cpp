#include "conchoid/surface/contacts.hpp"

#include <algorithm>
#include <map>

namespace conchoid {
namespace {

using Polygon = std::vector<Vec2>;

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
struct Tile {
  std::size_t fragment;
  Triangle corners;
  Vec3 area;
};

using PairArea = std::map<std::pair<std::size_t, std::size_t>, double>;

/// Contacts over one triangle of a sheet.
void add_contacts(const std::vector<Tile>& tiles, PairArea& shared) {
  const Vec3 normal = std::max_element(tiles.begin(), tiles.end(), [](const Tile& x, const Tile& y) {
                        return x.area.squaredNorm() < y.area.squaredNorm();
                      })->area.normalized();
  for (const Tile& up : tiles)
    for (const Tile& down : tiles)
      if (up.fragment != down.fragment && up.area.dot(normal) > 0 && down.area.dot(normal) < 0)
        if (const double area = common_area(up.corners, down.corners, normal); area > 0)
          shared[std::minmax(up.fragment, down.fragment)] += area;
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
  std::map<TriId, std::vector<Tile>> tiles_of;
  for (std::size_t f = 0; f < fragments.size(); ++f) {
    const Fragment& piece = fragments[f];
    for (std::size_t t = 0; t < piece.mesh.triangle_count(); ++t)
      if (piece.face_kind[t] == FaceKind::fracture)
        if (const Vec3 area = area_vector(piece.mesh, TriId(t)); !area.isZero(0))
          tiles_of[piece.source[t]].push_back({f, piece.mesh.triangle(TriId(t)), area});
  }
  PairArea shared;
  for (const auto& [source, tiles] : tiles_of)
    add_contacts(tiles, shared);
  std::vector<FragmentContact> contacts;
  for (const auto& [pair, area] : shared)
    contacts.push_back({pair.first, pair.second, area});
  return contacts;
}

}  // namespace conchoid
