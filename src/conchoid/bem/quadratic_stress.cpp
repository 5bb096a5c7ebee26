#include "conchoid/bem/quadratic_stress.hpp"

#include <cmath>
#include <map>
#include <mutex>
#include <optional>

#include "conchoid/bem/interior_stress.hpp"
#include "conchoid/bem/surface_stress.hpp"
#include "conchoid/mesh/closest_point.hpp"

namespace conchoid {
namespace {

constexpr double kOnSurface = 1e-7;    // × radius of the nearest panel: no distance
constexpr double kNearSurface = 0.02;  // × radius: nearer than this the integrals meet the panels' own edges

Vec3 barycentric(const Triangle& x, const Vec3& p) {
  const Vec3 n2 = area_vector2(x[0], x[1], x[2]);
  Vec3 l;
  for (int k = 0; k < 3; ++k)
    l[k] = n2.dot(area_vector2(p, x[(k + 1) % 3], x[(k + 2) % 3])) / n2.squaredNorm();
  return l;
}

std::array<Vec3, 3> tangent_at(const QuadraticSolution& solution, std::size_t panel, const Vec3& l) {
  std::array<Vec3, 6> u;
  for (std::size_t k = 0; k < 6; ++k)
    u[k] = solution.displacement[solution.space->nodes[panel][k]];
  return tangent_of(u, l);
}

Vec3 displacement_at(const QuadraticSolution& solution, std::size_t panel, const Vec3& l) {
  const Eigen::Matrix<double, 6, 1> phi = quadratic_functions(l);
  Vec3 u = Vec3::Zero();
  for (int k = 0; k < 6; ++k)
    u += phi[k] * solution.displacement[solution.space->nodes[panel][static_cast<std::size_t>(k)]];
  return u;
}

/// What the elements computed, without the ambient field.
Mat3 computed_stress(const QuadraticSolution& solution, std::size_t panel, const Vec3& l) {
  const auto& t = solution.traction[panel];
  return surface_stress(solution.space->corners.panels[panel].x, tangent_at(solution, panel, l),
                        l[0] * t[0] + l[1] * t[1] + l[2] * t[2], solution.space->corners.m);
}

/// x ↦ u + G (x − at), and its stress.
struct LinearField {
  Vec3 at, u;
  Mat3 gradient, stress;
};

/// The linear displacement that touches the solution in a point of the surface. Its gradient across the surface follows
/// from strain and traction: G = ε + ω, ω P = G P − ε P =: M, ω = M − (Mᵀn) nᵀ.
LinearField touching_field(const QuadraticSolution& solution, std::size_t panel, const Vec3& l) {
  const Panel& p = solution.space->corners.panels[panel];
  const std::array<Vec3, 3> w = tangent_at(solution, panel, l);
  Mat3 along = Mat3::Zero();
  for (int k = 0; k < 3; ++k)
    along += w[static_cast<std::size_t>(k)] *
             cross(p.normal, p.x[(k + 2) % 3] - p.x[(k + 1) % 3]).transpose() / (2 * p.area);
  LinearField field;
  field.at = l[0] * p.x[0] + l[1] * p.x[1] + l[2] * p.x[2];
  field.u = displacement_at(solution, panel, l);
  field.stress = computed_stress(solution, panel, l);
  const Mat3 strain = strain_of(field.stress, solution.space->corners.m);
  const Mat3 M = along - strain * (Mat3::Identity() - p.normal * p.normal.transpose());
  field.gradient = strain + M - (M.transpose() * p.normal) * p.normal.transpose();
  return field;
}

class Field {
 public:
  explicit Field(QuadraticSolution solution)
      : solution_(std::move(solution)), nearest_(solution_.space->corners.surface) {}

  Mat3 stress(const Vec3& x) const {
    const std::array<double, 3> key = {x[0], x[1], x[2]};
    {
      const std::lock_guard lock(mutex_);
      if (const auto known = kept_.find(key); known != kept_.end()) return known->second;
    }
    Mat3 s = computed_stress_at(x);
    if (solution_.ambient.stress) s += solution_.ambient.stress(x);
    const std::lock_guard lock(mutex_);
    return kept_.try_emplace(key, s).first->second;
  }

  Vec3 displacement(const Vec3& x) const {
    const Place place = nearest(x);
    Vec3 u = place.distance <= kOnSurface * place.radius
                 ? displacement_at(solution_, place.panel, place.l)
                 : Vec3(place.touching->u + place.touching->gradient * (x - place.touching->at));
    if (solution_.ambient.displacement) u += solution_.ambient.displacement(x);
    return u;
  }

 private:
  struct Place {
    std::size_t panel;
    Vec3 l, point;
    double distance, radius;
    std::optional<LinearField> touching;  // off the surface
  };

  Place nearest(const Vec3& x) const {
    const ClosestPointTree::Hit hit = nearest_.closest(x);
    const Panel& p = solution_.space->corners.panels[hit.triangle.index()];
    Place place{hit.triangle.index(),
                barycentric(p.x, hit.point),
                hit.point,
                std::sqrt(hit.squared_distance),
                p.radius,
                {}};
    if (place.distance > kOnSurface * place.radius)
      place.touching = touching_field(solution_, place.panel, place.l);
    return place;
  }

  Mat3 computed_stress_at(const Vec3& x) const {
    const Place place = nearest(x);
    const double near = kNearSurface * place.radius;
    if (!place.touching) return computed_stress(solution_, place.panel, place.l);
    if (place.distance >= near) return inner_stress(x, *place.touching);
    const Vec3 off = place.point + near / place.distance * (x - place.point);
    const Mat3& on = place.touching->stress;
    return on + place.distance / near * (inner_stress(off, *place.touching) - on);
  }

  Mat3 inner_stress(const Vec3& x, const LinearField& off) const {
    const QuadraticSpace& space = *solution_.space;
    std::vector<QuadraticLoadedPanel> panels;
    panels.reserve(space.nodes.size());
    for (std::size_t t = 0; t < space.nodes.size(); ++t) {
      QuadraticLoadedPanel p{space.corners.panels[t], solution_.traction[t], {}};
      for (Vec3& traction : p.traction)
        traction -= off.stress * p.panel.normal;
      for (std::size_t k = 0; k < 6; ++k) {
        const std::size_t node = space.nodes[t][k];
        p.density[k] = solution_.displacement[node] - off.u - off.gradient * (space.positions[node] - off.at);
      }
      panels.push_back(std::move(p));
    }
    return off.stress + interior_stress(x, panels, space.corners.m);
  }

  QuadraticSolution solution_;
  ClosestPointTree nearest_;
  mutable std::mutex mutex_;
  mutable std::map<std::array<double, 3>, Mat3> kept_;
};

}  // namespace

std::array<Vec3, 3> tangent_of(const std::array<Vec3, 6>& u, const Vec3& l) {
  std::array<Vec3, 3> w;
  for (std::size_t j = 0; j < 3; ++j) {
    const std::size_t before = (j + 2) % 3, after = (j + 1) % 3;
    w[j] = (4 * l[static_cast<int>(j)] - 1) * u[j] + 4 * l[static_cast<int>(after)] * u[3 + j] +
           4 * l[static_cast<int>(before)] * u[3 + before];
  }
  return w;
}

Mat3 surface_stress(const QuadraticSolution& solution, TriId triangle, const Vec3& l) {
  Mat3 stress = computed_stress(solution, triangle.index(), l);
  const Triangle& x = solution.space->corners.panels[triangle.index()].x;
  if (solution.ambient.stress) stress += solution.ambient.stress(l[0] * x[0] + l[1] * x[1] + l[2] * x[2]);
  return stress;
}

AmbientField field_of(QuadraticSolution solution) {
  const auto field = std::make_shared<const Field>(std::move(solution));
  return {[field](const Vec3& x) { return field->stress(x); },
          [field](const Vec3& x) { return field->displacement(x); }};
}

LoadCase as_field(const QuadraticBody& body, const LoadCase& load) {
  const TriMesh& surface = body.space().corners.surface;
  return load_case(surface, free_surface(surface), field_of(body.solve(load)));
}

}  // namespace conchoid
