#include "conchoid/bem/cracked_body.hpp"

#include <cmath>
#include <numeric>

#include "conchoid/bem/quadratic_body.hpp"
#include "conchoid/bem/quadratic_rows.hpp"
#include "conchoid/bem/quadratic_stress.hpp"
#include "conchoid/bem/surface_stress.hpp"
#include "conchoid/core/parallel.hpp"

namespace conchoid {

struct CrackedBody::State {
  std::shared_ptr<const BodyOperator> body;
  LoadCase load;
  RowStore* store = nullptr;
  std::vector<double> reduced_load;  // CrackHost::reduced_loads()
  CrackSystem crack;
  std::size_t cut_nodes = 0;
  std::vector<double> solution;      // (q, u)
  std::vector<double> coefficients;  // of the enrichment functions
  IdVector<NodeId, Vec3> opening;
  ContactReport contact;

  State(std::shared_ptr<const BodyOperator> b, LoadCase l) : body(std::move(b)), crack(body) {
    set_load(std::move(l));
  }

  const TriMesh& surface() const { return body->surface(); }

  void set_load(LoadCase wanted) {
    reduced_load = crack.host().reduced_loads({&wanted, 1});
    crack.need_sources(sources_of(wanted));
    load = std::move(wanted);
  }

  // Coefficients of the crack under a load, which reduced is z.
  std::vector<double> solve_crack(const LoadCase& of, const double* z, ContactReport& report) const {
    std::vector<double> a = crack.right_hand_side(of);
    crack.subtract_load(z, a);
    crack.solve(a.data());
    report = {};
    if (!body->settings().contact) return a;
    std::vector<OpeningConstraint> constraints;
    for (std::size_t f = 0; f < crack.functions().size(); ++f)
      if (const CrackSystem::Function& function = crack.functions()[f];
          function.carries_opening() && !function.normal.isZero(0))
        constraints.push_back({3 * f, function.normal});
    report =
        close_penetrating_faces(a, constraints, [&](double* b, std::size_t count) { crack.solve(b, count); });
    return a;
  }

  IdVector<NodeId, Vec3> opening_of(const std::vector<double>& a) const {
    IdVector<NodeId, Vec3> out(cut_nodes, Vec3::Zero());
    for (std::size_t f = 0; f < crack.functions().size(); ++f)
      if (const CrackSystem::Function& function = crack.functions()[f]; function.carries_opening())
        out[function.node] = Eigen::Map<const Vec3>(&a[3 * f]);
    return out;
  }

  // use(panel, values at its corners, coefficient) for every panel of every enrichment function.
  template <class Use>
  void for_each_enrichment(const Use& use) const {
    for (std::size_t f = 0; f < crack.space().functions.size(); ++f)
      for (const PanelValues& v : crack.space().functions[f].support)
        use(v.panel, v.w, Eigen::Map<const Vec3>(&coefficients[3 * crack.position()[f]]));
  }

  // Displacement and traction that the elements compute (without the ambient field).
  IdVector<NodeId, Vec3> computed_displacement() const {
    IdVector<NodeId, Vec3> u = load.displacement;
    crack.host().add_displacement(solution.data(), u);
    return u;
  }
  std::vector<Vec3> computed_traction() const {
    std::vector<Vec3> t = load.traction;
    crack.host().add_traction(solution.data(), t);
    return t;
  }
};

CrackedBody::CrackedBody(std::shared_ptr<const BodyOperator> body, LoadCase load)
    : state_(std::make_unique<State>(std::move(body), std::move(load))) {}
CrackedBody::~CrackedBody() = default;
CrackedBody::CrackedBody(CrackedBody&&) noexcept = default;
CrackedBody& CrackedBody::operator=(CrackedBody&&) noexcept = default;

void CrackedBody::keep_rows(RowStore* store) {
  state_->store = store;
}

void CrackedBody::set_crack(const CutComplex& cut, const CutDivision& division) {
  state_->cut_nodes = cut.positions.size();
  state_->crack.set_crack(cut, division, state_->store);
}

void CrackedBody::set_load(LoadCase load) {
  state_->set_load(std::move(load));
}

const BodyOperator& CrackedBody::body() const {
  return *state_->body;
}

const LoadCase& CrackedBody::load() const {
  return state_->load;
}

const ContactReport& CrackedBody::contact() const {
  return state_->contact;
}

void CrackedBody::solve() {
  State& s = *state_;
  s.coefficients = s.solve_crack(s.load, s.reduced_load.data(), s.contact);
  s.solution = s.crack.body_unknowns(s.reduced_load, s.coefficients);
  s.opening = s.opening_of(s.coefficients);
}

std::vector<IdVector<NodeId, Vec3>> CrackedBody::openings(std::span<const LoadCase> loads) {
  State& s = *state_;
  const std::vector<double> reduced = s.crack.host().reduced_loads(loads);
  std::vector<IdVector<NodeId, Vec3>> out;
  for (std::size_t i = 0; i < loads.size(); ++i) {
    s.crack.need_sources(sources_of(loads[i]));
    ContactReport report;
    const double* z = reduced.data() + i * s.crack.host().unknowns();
    out.push_back(s.opening_of(s.solve_crack(loads[i], z, report)));
  }
  return out;
}

const IdVector<NodeId, Vec3>& CrackedBody::opening() const {
  return state_->opening;
}

IdVector<NodeId, Vec3> CrackedBody::displacement() const {
  const State& s = *state_;
  IdVector<NodeId, Vec3> u = s.computed_displacement();
  if (s.load.ambient.displacement)
    for (std::size_t i = 0; i < u.size(); ++i)
      u[NodeId(i)] += s.load.ambient.displacement(s.surface().positions[NodeId(i)]);
  return u;
}

std::vector<Vec3> CrackedBody::traction() const {
  const State& s = *state_;
  std::vector<Vec3> t = s.computed_traction();
  if (s.load.ambient.stress)
    for (std::size_t x = 0; x < t.size(); ++x)
      t[x] += s.load.ambient.stress(s.body->discretisation().panels[x].center) *
              s.body->discretisation().panels[x].normal;
  return t;
}

// Every panel after the cut with its traction and density.
std::vector<LoadedPanel> CrackedBody::loaded_panels() const {
  const State& s = *state_;
  const IdVector<NodeId, Vec3> u = s.computed_displacement();
  const std::vector<Vec3> t = s.computed_traction();
  std::vector<LoadedPanel> panels;
  for (std::size_t x = 0; x < s.crack.space().panels.size(); ++x) {
    LoadedPanel p{s.crack.space().panels[x], Vec3::Zero(), {Vec3::Zero(), Vec3::Zero(), Vec3::Zero()}};
    if (x < s.crack.space().surface_count) {
      p.traction = t[s.crack.space().parent[x].index()];
      const auto& nodes = s.surface().corners[s.crack.space().parent[x]];
      for (int k = 0; k < 3; ++k)
        for (int j = 0; j < 3; ++j)
          p.density[k] += s.crack.space().parent_values[x][k][j] * u[nodes[j]];
    }
    panels.push_back(std::move(p));
  }
  s.for_each_enrichment([&](std::size_t panel, const std::array<double, 3>& w, const Vec3& coefficient) {
    for (std::size_t k = 0; k < 3; ++k)
      panels[panel].density[k] += w[k] * coefficient;
  });
  return panels;
}

std::vector<QuadraticLoadedPanel> CrackedBody::quadratic_panels() const {
  const State& s = *state_;
  std::vector<QuadraticLoadedPanel> panels =
      loaded_pieces(s.body->settings().quadratic->space(), s.crack.space(), s.solution);
  s.for_each_enrichment([&](std::size_t panel, const std::array<double, 3>& w, const Vec3& coefficient) {
    for (std::size_t k = 0; k < 3; ++k) {
      panels[panel].density[k] += w[k] * coefficient;
      panels[panel].density[3 + k] += 0.5 * (w[k] + w[(k + 1) % 3]) * coefficient;
    }
  });
  return panels;
}

// Stress on a piece of the surface in the mean, without the ambient field.
std::vector<Mat3> CrackedBody::stress_on_pieces() const {
  const State& s = *state_;
  std::vector<Mat3> out;
  if (s.body->settings().quadratic) {
    const Vec3 middle = Vec3::Constant(1.0 / 3);
    const std::vector<QuadraticLoadedPanel> panels = quadratic_panels();
    for (std::size_t x = 0; x < s.crack.space().surface_count; ++x) {
      const auto& t = panels[x].traction;
      out.push_back(conchoid::surface_stress(panels[x].panel.x, tangent_of(panels[x].density, middle),
                                             (t[0] + t[1] + t[2]) / 3, s.body->material()));
    }
    return out;
  }
  const std::vector<LoadedPanel> panels = loaded_panels();
  for (std::size_t x = 0; x < s.crack.space().surface_count; ++x)
    out.push_back(conchoid::surface_stress(panels[x].panel.x, panels[x].density, panels[x].traction,
                                           s.body->material()));
  return out;
}

// The same inside.
std::vector<Mat3> CrackedBody::stress_inside(std::span<const Vec3> points) const {
  const State& s = *state_;
  if (!s.body->settings().quadratic)
    return conchoid::interior_stress(points, loaded_panels(), s.body->material());
  const std::vector<QuadraticLoadedPanel> panels = quadratic_panels();
  return parallel_values(points.size(), 1, [&](std::size_t i) {
    return conchoid::interior_stress(points[i], panels, s.body->material());
  });
}

std::vector<Mat3> CrackedBody::surface_stress() const {
  const State& s = *state_;
  std::vector<Mat3> stress(s.surface().triangle_count(), Mat3::Zero());
  const std::vector<Mat3> on_pieces = stress_on_pieces();
  for (std::size_t x = 0; x < s.crack.space().surface_count; ++x) {
    const std::size_t parent = s.crack.space().parent[x].index();
    const Panel& p = s.crack.space().panels[x];
    Mat3 value = on_pieces[x];
    if (s.load.ambient.stress) value += s.load.ambient.stress(p.center);
    stress[parent] += p.area / s.body->discretisation().panels[parent].area * value;
  }
  return stress;
}

std::vector<Mat3> CrackedBody::interior_stress(std::span<const Vec3> points) const {
  const State& s = *state_;
  std::vector<Mat3> stress = stress_inside(points);
  if (s.load.ambient.stress)
    for (std::size_t i = 0; i < points.size(); ++i)
      stress[i] += s.load.ambient.stress(points[i]);
  return stress;
}

std::vector<CrackFaceStress> CrackedBody::crack_face_stress(const std::vector<TriId>& pieces) const {
  constexpr double off_the_face = 0.4;  // in edges of the triangle
  const State& s = *state_;
  const std::vector<LoadedPanel> panels = loaded_panels();
  std::vector<Vec3> points;  // four per piece: near and far on either side
  for (TriId piece : pieces) {
    const Panel& p = panels[s.crack.space().surface_count + piece.index()].panel;
    const Vec3 off = off_the_face * std::sqrt(2 * p.area) * p.normal;
    for (const double times : {1.0, -1.0, 2.0, -2.0})
      points.push_back(p.center + times * off);
  }
  const std::vector<Mat3> around = stress_inside(points);
  std::vector<CrackFaceStress> out(pieces.size());
  for (std::size_t i = 0; i < pieces.size(); ++i) {
    const LoadedPanel& face = panels[s.crack.space().surface_count + pieces[i].index()];
    const Panel& p = face.panel;
    const Mat3* at = &around[4 * i];
    Mat3 base = 2 * (0.5 * (at[0] + at[1])) - 0.5 * (at[2] + at[3]);
    if (s.load.ambient.stress) base += s.load.ambient.stress(p.center);
    const Mat3 strain = strain_of(base, s.body->material());
    for (const double side : {1.0, -1.0}) {
      std::array<Vec3, 3> u;
      for (int k = 0; k < 3; ++k)
        u[k] = strain * (p.x[k] - p.center) - 0.5 * side * face.density[k];
      (side > 0 ? out[i].plus : out[i].minus) =
          conchoid::surface_stress(p.x, u, base * p.normal, s.body->material());
    }
  }
  return out;
}

const AppendStatistics& CrackedBody::statistics() const {
  return state_->crack.statistics();
}

// f_N·u + f_a·a − f_D·q: the signs of the system made symmetric.
double CrackedBody::energy() const {
  const State& s = *state_;
  const std::size_t nq = s.body->discretisation().tractions();
  const std::vector<double> f = s.body->settings().quadratic ? std::vector<double>()  // nothing is prescribed
                                                             : s.body->right_hand_sides({&s.load, 1});
  const std::vector<double> g = s.crack.right_hand_side(s.load);
  double work = std::inner_product(g.begin(), g.end(), s.coefficients.begin(), 0.0);
  for (std::size_t i = 0; i < f.size(); ++i)
    work += (i < nq ? -1 : 1) * f[i] * s.solution[i];
  return 0.5 * work;
}

CrackedBody make_cracked_body(TriMesh surface, const BoundaryData& data, const ElasticConstants& m,
                              AmbientField ambient, const BemSettings& settings) {
  LoadCase load = load_case(surface, data, std::move(ambient));
  return CrackedBody(make_body_operator(std::move(surface), data, m, settings), std::move(load));
}

}  // namespace conchoid
