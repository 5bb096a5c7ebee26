#include "conchoid/sim/world.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "conchoid/bem/cracked_body.hpp"
#include "conchoid/core/error.hpp"
#include "conchoid/core/random.hpp"
#include "conchoid/mesh/closest_point.hpp"
#include "conchoid/sim/crack_sites.hpp"
#include "conchoid/sim/world_bodies.hpp"

namespace conchoid {
namespace {

// Streams of random numbers: bodies and loads do not depend on each other.
constexpr std::uint64_t kBodies = 0x626f6479, kLoads = 0x6c6f6164;
constexpr double kDegrees = 180 / std::numbers::pi;

double log_uniform(Random& random, double low, double high) {
  return low * std::pow(high / low, random.uniform());
}

Vec3 any_normal_to(const Vec3& axis) {
  Eigen::Index least = 0;
  axis.cwiseAbs().minCoeff(&least);
  const Vec3 e = Vec3::Unit(least);
  return (e - e.dot(axis) * axis).normalized();
}

// A unit vector at an angle to an axis [degree], turned about it at random.
Vec3 sloped(const Vec3& axis, double slope, Random& random) {
  const Vec3 a = any_normal_to(axis), b = cross(axis, a);
  const double turn = random.uniform(0, 2 * std::numbers::pi), s = slope / kDegrees;
  return std::cos(s) * axis + std::sin(s) * (std::cos(turn) * a + std::sin(turn) * b);
}

// Extent of a mesh along a direction.
std::array<double, 2> extent(const TriMesh& mesh, const Vec3& direction) {
  double low = mesh.positions[NodeId(0)].dot(direction), high = low;
  for (const Vec3& x : mesh.positions) {
    low = std::min(low, x.dot(direction));
    high = std::max(high, x.dot(direction));
  }
  return {low, high};
}

// The thinnest slice at the end of a body, seen along `out`, that holds a few triangles and some area.
std::vector<TriId> end_of(const TriMesh& mesh, const Vec3& out) {
  const auto [low, high] = extent(mesh, out);
  const double area = surface_area(mesh);
  std::vector<TriId> found;
  for (const double share : {0.001, 0.05, 0.1, 0.15, 0.2, 0.25, 0.3, 0.35}) {
    found.clear();
    double its_area = 0;
    for (std::size_t t = 0; t < mesh.triangle_count(); ++t) {
      const Triangle x = mesh.triangle(TriId(t));
      const double d = std::min({x[0].dot(out), x[1].dot(out), x[2].dot(out)});
      if (d < high - share * (high - low) - 1e-9) continue;
      found.emplace_back(t);
      its_area += area_vector(mesh, TriId(t)).norm();
    }
    if (found.size() >= 4 && its_area > 0.02 * area) break;
  }
  return found;
}

// Walls that look at the z axis, of bodies turned about it.
bool looks_inside(const TriMesh& mesh, TriId t) {
  const Vec3 x = centroid(mesh, t), n = unit_normal(mesh, t);
  return n[0] * x[0] + n[1] * x[1] < -0.3 * std::hypot(x[0], x[1]);
}

std::vector<Region> regions_of(const TriMesh& mesh, const Vec3& axis, bool hollow) {
  std::vector<Region> regions = {{"low", end_of(mesh, -axis)}, {"high", end_of(mesh, axis)}};
  std::vector<char> taken(mesh.triangle_count(), 0);
  for (const Region& region : regions)
    for (const TriId t : region.triangles)
      taken[t.index()] = 1;
  const Vec3 across = any_normal_to(axis);
  const auto [low, high] = extent(mesh, axis);
  const auto [near, far] = extent(mesh, across);
  Region side{"side", {}}, inside{"inside", {}};
  for (std::size_t i = 0; i < mesh.triangle_count(); ++i) {
    if (taken[i]) continue;
    const TriId t(i);
    const Vec3 x = centroid(mesh, t);
    if (hollow && looks_inside(mesh, t))
      inside.triangles.push_back(t);
    else if (x.dot(across) > 0.5 * (near + far) + 0.15 * (far - near) &&
             std::abs(x.dot(axis) - 0.5 * (low + high)) < 0.2 * (high - low) &&
             unit_normal(mesh, t).dot(across) > 0.5)
      side.triangles.push_back(t);
  }
  for (Region* region : {&side, &inside})
    if (!region->triangles.empty()) regions.push_back(std::move(*region));
  return regions;
}

MaterialSpec random_material(double edge, Random& random) {
  MaterialSpec m;
  m.youngs_modulus = log_uniform(random, 1e9, 3e11);
  m.poisson_ratio = random.uniform(0.1, 0.4);
  m.strength = m.youngs_modulus * log_uniform(random, 5e-4, 3e-2);
  m.toughness = m.strength * std::sqrt(std::numbers::pi * edge) * log_uniform(random, 0.02, 0.4);
  return m;
}

// A disc or ellipse, under the surface or through it, roughly across the axis.
CrackSpec random_crack(const RandomBody& body, double edge, const std::string& where, Random& random) {
  const auto t = TriId(random.index(body.surface.triangle_count()));
  const double depth = std::max(0.3 * edge, random.uniform(0, 0.5) * body.thickness);
  CrackSpec crack;
  crack.center = centroid(body.surface, t) - depth * unit_normal(body.surface, t);
  crack.normal = sloped(body.axis, random.uniform(0, 45), random);
  crack.radius = random.uniform(2, 3.5) * edge;
  crack.where = where;
  if (random.uniform() < 0.5) return crack;
  crack.kind = CrackKind::ellipse;
  crack.axes = {crack.radius, crack.radius * random.uniform(0.6, 1)};
  crack.direction = any_normal_to(crack.normal);
  return crack;
}

// Nothing but the size of a load is left open.
WorldLoad unit_load(const WorldBody& body, Random& random) {
  const auto has = [&](const char* region) { return find_region(body.body.regions, region) != nullptr; };
  const auto held = std::count_if(body.scene.boundary.begin(), body.scene.boundary.end(),
                                  [](const auto& c) { return c.kind == ConditionKind::displacement; });
  WorldLoad load;
  load.seed = random.bits() >> 11;
  const double which = random.uniform();
  const auto add = [&](const char* region, double sign, const BoundaryCondition& condition) {
    BoundaryCondition c = condition;
    c.region = region;
    c.value *= sign;
    c.twist *= sign;
    load.conditions.push_back(std::move(c));
  };
  BoundaryCondition acting;
  acting.where = body.scene.file;
  if (held == 2 || (held == 0 && has("inside") && which < 0.3)) {
    load.kind = "pressure";
    acting.kind = ConditionKind::pressure;
    acting.pressure = 1;
    add(held == 2 ? "side" : "inside", 1, acting);
    return load;
  }
  const auto ends = [&] {
    add("high", 1, acting);
    if (held == 0) add("low", -1, acting);
  };
  if (which < 0.7) {
    load.kind = which < 0.5 ? "pull" : "shear";
    load.slope = which < 0.5 ? random.uniform(0, 45) : random.uniform(60, 90);
    load.direction = acting.value = sloped(body.axis, load.slope, random);
    ends();
    return load;
  }
  // Of a linear traction of about 1 Pa at the rim, with some pull beside it.
  load.kind = which < 0.88 ? "bend" : "twist";
  load.slope = load.kind == "bend" ? 90 : 0;
  load.direction = sloped(body.axis, load.slope, random);
  const Box box = bounding_box(body.body.surface);
  acting.about = box.center();
  acting.twist = load.direction / (0.25 * box.diagonal());
  acting.value = random.uniform(0, 0.6) * body.axis;
  ends();
  return load;
}

// How large the unit load must be.
double size_of(const WorldBody& body, const PreparedBody& prepared, const WorldLoad& unit, Random& random) {
  CrackedBody uncracked(prepared.elastic, load_of(loaded_scene(body, unit), prepared));
  CrackState none;
  none.cut = whole_surface(prepared.surface);
  uncracked.set_crack(none.cut);
  uncracked.solve();
  if (body.scene.cracks.empty()) {
    const double ratio = largest_stress(prepared, none, uncracked).ratio;
    if (!(ratio > 0)) throw ComputationError("the load drawn stretches the surface nowhere");
    return random.uniform(1.02, 1.6) / ratio;
  }
  const CrackSpec& crack = body.scene.cracks.front();
  const Vec3 n = crack.normal.normalized();
  const double across = n.dot(uncracked.interior_stress(crack.center - prepared.origin) * n);
  const double K = 2 / std::numbers::pi * across * std::sqrt(std::numbers::pi * crack.radius);
  const double wanted = log_uniform(random, 1.1, 10) * prepared.material.toughness;
  constexpr double least = 1e-3;  // × stress of the load: there is hardly any across the crack
  if (!(std::abs(across) > least)) throw ComputationError("the load drawn does not open the crack");
  return wanted / K;  // below 0 where it pressed: then it acts the other way round
}

}  // namespace

WorldBody draw_world_body(const WorldSpec& world, std::uint64_t seed, int body) {
  Random random(seed ^ kBodies, static_cast<std::uint64_t>(body));
  WorldBody out;
  out.body_class = world.classes[static_cast<std::size_t>(body) % world.classes.size()];
  out.scene.file = "[world], body " + std::to_string(body) + " (" + out.body_class + ")";
  const RandomBody drawn = out.body_class == kScanClass ? random_scan(world.scans, world.elements, random)
                                                        : random_body(out.body_class, world.elements, random);
  out.axis = drawn.axis;
  out.body.name = out.scene.file;
  out.body.surface = out.body.detailed = drawn.surface;
  out.body.regions = regions_of(drawn.surface, drawn.axis, drawn.hollow);
  const double edge =
      std::min(random.uniform(0.1, 0.15) * std::cbrt(enclosed_volume(drawn.surface)), 0.5 * drawn.thickness);
  out.scene.resolution.crack = edge;
  out.scene.resolution.surface = edge / 10;
  out.scene.material = random_material(edge, random);
  out.scene.run.elements = ElementOrder::linear;
  const double support = random.uniform();
  const bool pressed = find_region(out.body.regions, "side") != nullptr;
  const auto hold = [&](const char* region) {
    BoundaryCondition c;
    c.region = region;
    c.kind = ConditionKind::displacement;
    c.where = out.scene.file;
    out.scene.boundary.push_back(c);
  };
  if (support > 0.6) hold("low");
  if (support > 0.85 && pressed) hold("high");
  out.scene.run.inertia_relief = out.scene.boundary.empty();
  if (random.uniform() < world.cracked) {
    out.scene.cracks.push_back(random_crack(drawn, edge, out.scene.file, random));
    out.scene.run.max_cracks = 0;
  }
  return out;
}

std::shared_ptr<const PreparedBody> prepare(const WorldBody& body) {
  Scene scene = body.scene;
  scene.run.inertia_relief = true;  // whatever acts
  return std::make_shared<const PreparedBody>(prepare(scene, body.body));
}

WorldLoad draw_world_load(const WorldBody& body, const PreparedBody& prepared, std::uint64_t seed, int run) {
  Random random(seed ^ kLoads, static_cast<std::uint64_t>(run));
  WorldLoad load = unit_load(body, random);
  const double size = size_of(body, prepared, load, random);
  load.magnitude = std::abs(size);
  if (size < 0) load.direction = -load.direction;
  for (BoundaryCondition& c : load.conditions) {
    c.value *= size;
    c.twist *= size;
    c.pressure *= size;
  }
  return load;
}

Scene loaded_scene(const WorldBody& body, const WorldLoad& load) {
  Scene scene = body.scene;
  scene.run.seed = load.seed;
  scene.boundary.insert(scene.boundary.end(), load.conditions.begin(), load.conditions.end());
  return scene;
}

}  // namespace conchoid
