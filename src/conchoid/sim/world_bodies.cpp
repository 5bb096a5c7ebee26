#include "conchoid/sim/world_bodies.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "conchoid/core/error.hpp"
#include "conchoid/mesh/models.hpp"
#include "conchoid/mesh/polygon_triangles.hpp"
#include "conchoid/mesh/turned_bodies.hpp"
#include "conchoid/remesh/remesh.hpp"
#include "conchoid/remesh/wall_resolution.hpp"
#include "conchoid/surface/convex_hull.hpp"

namespace conchoid {
namespace {

constexpr int kScanTriangles = 20;     // of a scan for each element
constexpr double kScanStretch = 1.25;  // at most, of each extent

// Edge of so many equilateral triangles on a surface.
double edge_for(double area, int elements) {
  return std::sqrt(4 / std::sqrt(3.0) * area / elements);
}

int cells(double length, double edge) {
  return std::max(1, static_cast<int>(std::lround(length / edge)));
}

RandomBody box(const Vec3& size, int elements, const Vec3& axis) {
  const double area = 2 * (size[0] * size[1] + size[1] * size[2] + size[2] * size[0]);
  const double edge = edge_for(area, elements);
  return {box_mesh(size, cells(size[0], edge), cells(size[1], edge), cells(size[2], edge)), axis,
          size.minCoeff()};
}

RandomBody random_box(int elements, Random& random) {
  const Vec3 size{random.uniform(0.4, 1), random.uniform(0.4, 1), random.uniform(0.4, 1)};
  return box(size, elements, Vec3::Unit(static_cast<Eigen::Index>(random.index(3))));
}

RandomBody random_plate(int elements, Random& random) {
  const Vec3 size{random.uniform(0.7, 1), random.uniform(0.5, 1), random.uniform(0.1, 0.22)};
  return box(size, elements, Vec3::Unit(static_cast<Eigen::Index>(random.index(2))));
}

// A polygon in the plane z = 0, counter-clockwise, drawn up to height h on both sides.
TriMesh prism(const std::vector<Vec2>& polygon, double h) {
  TriMesh mesh;
  std::vector<NodeId> low, high;
  for (const Vec2& p : polygon)
    low.push_back(mesh.positions.add({p[0], p[1], -h}));
  for (const Vec2& p : polygon)
    high.push_back(mesh.positions.add({p[0], p[1], h}));
  const std::size_t n = polygon.size();
  for (std::size_t i = 0; i < n; ++i) {
    const std::size_t k = (i + 1) % n;
    mesh.corners.push_back({low[i], low[k], high[k]});
    mesh.corners.push_back({low[i], high[k], high[i]});
  }
  for (const auto& [a, b, c] : polygon_triangles(mesh.positions, high)) {
    mesh.corners.push_back({high[a], high[b], high[c]});
    mesh.corners.push_back({low[a], low[c], low[b]});
  }
  return mesh;
}

RandomBody random_prism(int elements, Random& random) {
  const auto corners = 3 + random.index(6);
  const double radius = random.uniform(0.35, 0.5);
  std::vector<Vec2> polygon;
  for (std::uint64_t i = 0; i < corners; ++i) {
    const double angle = 2 * std::numbers::pi * (static_cast<double>(i) + random.uniform(-0.3, 0.3)) /
                         static_cast<double>(corners);
    polygon.emplace_back(radius * random.uniform(0.7, 1) * Vec2(std::cos(angle), std::sin(angle)));
  }
  const double height = random.uniform(0.5, 1.4);
  return {remesh(prism(polygon, height / 2), elements), Vec3::UnitZ(), std::min(radius, height)};
}

RandomBody random_rod(int elements, Random& random) {
  const double length = 1, width = random.uniform(0.25, 0.45), depth = random.uniform(0.2, 0.45);
  const double notch = depth * random.uniform(0.1, 0.35), opening = notch * random.uniform(0.5, 1.5);
  const double middle = random.uniform(-0.1, 0.1);
  const double l = length / 2, d = depth / 2;
  TriMesh mesh = prism({{-l, -d},
                        {middle - opening / 2, -d},
                        {middle, notch - d},
                        {middle + opening / 2, -d},
                        {l, -d},
                        {l, d},
                        {-l, d}},
                       width / 2);
  return {remesh(mesh, elements), Vec3::UnitX(), std::min(width, depth - notch)};
}

// Circles of a turned body are as finely divided as its outline.
TriMesh turned(const std::vector<OutlinePoint>& outline, OutlineKind kind, double area, double radius,
               int elements) {
  const double edge = edge_for(area, elements);
  const int around = std::max(10, 2 * static_cast<int>(std::lround(std::numbers::pi * radius / edge)));
  return turned_body(divided_outline(outline, edge, kind), around, kind);
}

RandomBody random_cylinder(int elements, Random& random) {
  const double r = random.uniform(0.25, 0.5), h = random.uniform(0.25, 0.6);
  const double area = 2 * std::numbers::pi * r * (r + 2 * h);
  return {turned({{0, -h}, {r, -h}, {r, h}, {0, h}}, OutlineKind::on_axis, area, r, elements), Vec3::UnitZ(),
          std::min(2 * r, 2 * h)};
}

RandomBody random_tube(int elements, Random& random) {
  const double outer = 0.5, inner = outer * random.uniform(0.4, 0.75), h = random.uniform(0.12, 0.6);
  const double area = 2 * std::numbers::pi * ((outer + inner) * 2 * h + outer * outer - inner * inner);
  return {
      turned({{outer, -h}, {outer, h}, {inner, h}, {inner, -h}}, OutlineKind::ring, area, outer, elements),
      Vec3::UnitZ(), std::min(outer - inner, 2 * h), true};
}

RandomBody random_cup(int elements, Random& random) {
  const double h = random.uniform(0.3, 0.6), wall = random.uniform(0.12, 0.2);
  const double foot = random.uniform(0.3, 0.5), belly = random.uniform(0.35, 0.5),
               rim = random.uniform(0.3, 0.5);
  const double area = 4 * std::numbers::pi * belly * 2 * h + 2 * std::numbers::pi * foot * foot;
  const std::vector<OutlinePoint> outline = {{0, -h},
                                             {foot, -h},
                                             {belly, 0},
                                             {rim, h},
                                             {rim - wall, h},
                                             {belly - wall, 0},
                                             {foot - wall, wall - h},
                                             {0, wall - h}};
  return {turned(outline, OutlineKind::on_axis, area, belly, elements), Vec3::UnitZ(), wall, true};
}

RandomBody random_blob(int elements, Random& random) {
  TriMesh mesh = icosphere(0.5, elements > 200 ? 2 : 1);
  const Vec3 stretch{random.uniform(0.6, 1), random.uniform(0.6, 1), random.uniform(0.6, 1)};
  for (int wave = 0; wave < 4; ++wave) {
    const Vec3 direction = random.uniform(2, 6) * random.unit_vector();
    const double phase = random.uniform(0, 2 * std::numbers::pi), height = random.uniform(0.02, 0.08);
    for (Vec3& x : mesh.positions)
      x *= 1 + height * std::cos(direction.dot(x) / x.norm() + phase);
  }
  for (Vec3& x : mesh.positions)
    x = x.cwiseProduct(stretch);
  return {mesh, random.unit_vector(), stretch.minCoeff()};
}

RandomBody random_polyhedron(int elements, Random& random) {
  TriMesh points;
  const auto count = 8 + random.index(12);
  const Vec3 stretch{random.uniform(0.6, 1), random.uniform(0.6, 1), random.uniform(0.6, 1)};
  for (std::uint64_t i = 0; i < count; ++i)
    points.positions.push_back(0.6 * random.unit_vector().cwiseProduct(stretch));
  return {remesh(convex_hull(points), elements), random.unit_vector(), 0.8 * stretch.minCoeff()};
}

struct BodyClass {
  std::string_view name;
  RandomBody (*draw)(int elements, Random& random);
};
constexpr std::array<BodyClass, 9> classes = {{{"box", random_box},
                                               {"plate", random_plate},
                                               {"prism", random_prism},
                                               {"cylinder", random_cylinder},
                                               {"tube", random_tube},
                                               {"cup", random_cup},
                                               {"rod", random_rod},
                                               {"blob", random_blob},
                                               {"polyhedron", random_polyhedron}}};

}  // namespace

const std::vector<std::string_view>& body_class_names() {
  static const std::vector<std::string_view> names = [] {
    std::vector<std::string_view> all;
    for (const BodyClass& c : classes)
      all.push_back(c.name);
    return all;
  }();
  return names;
}

const std::vector<std::string_view>& world_class_names() {
  static const std::vector<std::string_view> names = [] {
    std::vector<std::string_view> all = body_class_names();
    all.push_back(kScanClass);
    return all;
  }();
  return names;
}

RandomBody random_body(std::string_view body_class, int elements, Random& random) {
  for (const BodyClass& c : classes)
    if (c.name == body_class) return c.draw(elements, random);
  throw InputError(fmt::format("there is no class of bodies \"{}\"; choose from {}", body_class,
                               fmt::join(body_class_names(), ", ")));
}

TriMesh scan_of(TriMesh body, int elements) {
  const Box box = bounding_box(body);
  for (Vec3& x : body.positions)
    x = (x - box.center()) / (box.high - box.low).maxCoeff();
  const int enough = kScanTriangles * elements;
  return body.triangle_count() <= static_cast<std::size_t>(enough) ? body : remesh_or_more(body, enough);
}

RandomBody random_scan(const std::vector<TriMesh>& scans, int elements, Random& random) {
  TriMesh mesh = scans[random.index(scans.size())];
  Vec3 stretch;
  for (double& factor : stretch)
    factor = std::pow(kScanStretch, random.uniform(-1, 1));
  for (Vec3& x : mesh.positions)
    x = x.cwiseProduct(stretch);
  RandomBody body{remesh_or_more(mesh, elements), random.unit_vector(), 0};
  const double across = bounding_box(body.surface).diagonal();
  body.thickness = thinnest_wall(body.surface, across).value_or(across);
  return body;
}

}  // namespace conchoid
