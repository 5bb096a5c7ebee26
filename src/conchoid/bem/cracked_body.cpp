#include "conchoid/bem/cracked_body.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>

#include "conchoid/bem/bordered_cholesky.hpp"
#include "conchoid/bem/contact.hpp"
#include "conchoid/bem/rigid_body.hpp"
#include "conchoid/bem/row_store.hpp"
#include "conchoid/bem/surface_stress.hpp"
#include "conchoid/core/error.hpp"
#include "conchoid/core/parallel.hpp"

namespace conchoid {
namespace {

// A enrichment function that is in the system.
struct Member {
  EnrichmentKind kind;
  NodeId node;
  std::vector<double> key;
  DenseMatrix coupling;      // 3 × body unknowns: D_au + K_aᵀ V⁻¹ K
  DenseMatrix K;             // traction unknowns × 3
  DenseMatrix VinvK;         // V⁻¹ K
  Vec3 load = Vec3::Zero();  // f_a − K_aᵀ V⁻¹ f_D
  Vec3 normal = Vec3::Zero();
};

}  // namespace

struct CrackedBody::State {
  std::shared_ptr<const BodyOperator> body;
  LoadCase load;
  RowStore* store = nullptr;
  std::vector<double> VinvF;      // V⁻¹ f_D
  std::vector<double> body_load;  // f_N − Kᵀ V⁻¹ f_D
  BorderedCholesky P;  // of the Schur complement D + Kᵀ V⁻¹ K, body first, then members in order
  std::vector<Member> members;
  DenseMatrix among;         // 3·members square: D_aa + K_aᵀ V⁻¹ K_a
  std::size_t factored = 0;  // members eliminated in P
  EnrichedSpace space;
  std::vector<std::size_t> member_of;  // per function of space
  std::size_t cut_nodes = 0;
  std::vector<double> solution;
  IdVector<NodeId, Vec3> opening;
  AppendStatistics statistics;

  State(std::shared_ptr<const BodyOperator> b, LoadCase l)
      : body(std::move(b)),
        P(body->schur_factor()),
        space(make_enriched_space(whole_surface(surface()), surface(), body->kinds())) {
    set_load(std::move(l));
  }

  const TriMesh& surface() const { return body->surface(); }
  const Unknowns& unknowns() const { return body->blocks().unknowns; }

  Vec3 coefficient(std::size_t member) const {
    return Eigen::Map<const Vec3>(&solution[body_size() + 3 * member]);
  }

  // Displacement the elements compute (without the ambient field).
  IdVector<NodeId, Vec3> computed_displacement() const {
    IdVector<NodeId, Vec3> u = load.displacement;
    for (std::size_t i = 0; i < u.size(); ++i)
      if (const int at = unknowns().displacement[i]; at >= 0)
        u[NodeId(i)] = Eigen::Map<const Vec3>(&solution[3 * static_cast<std::size_t>(at)]);
    return u;
  }

  std::vector<Vec3> computed_traction() const;

  std::size_t body_size() const { return 3 * unknowns().displacement_count; }

  void set_load(LoadCase wanted);
  void reduce_load(Member& member) const;
  void replace_members();
  void eliminate_members();
};

void CrackedBody::State::set_load(LoadCase wanted) {
  BodyLoad f = body->load(wanted);
  load = std::move(wanted);
  VinvF = std::move(f.f_D);
  body->solve_single_layer(VinvF.data());
  body_load = std::move(f.f_N);
  const DenseMatrix& K = body->blocks().K;
  for (std::size_t q = 0; q < K.rows; ++q)
    for (std::size_t i = 0; i < body_load.size(); ++i)
      body_load[i] -= K(q, i) * VinvF[q];
  if (members.empty()) return;
  const std::vector<Vec3> loads = assemble_enrichment_loads({*body, load}, space);
  for (std::size_t f = 0; f < loads.size(); ++f) {
    Member& member = members[member_of[f]];
    member.load = loads[f];
    reduce_load(member);
  }
}

// f_a − K_aᵀ V⁻¹ f_D
void CrackedBody::State::reduce_load(Member& member) const {
  for (std::size_t q = 0; q < member.K.rows; ++q)
    for (int p = 0; p < 3; ++p)
      member.load[p] -= member.K(q, p) * VinvF[q];
}

// Functions with a known key keep their rows, in the order they had; new ones come after them.
void CrackedBody::State::replace_members() {
  std::map<std::vector<double>, std::size_t> index_of_key;
  for (std::size_t f = 0; f < space.functions.size(); ++f)
    index_of_key.emplace(space.functions[f].key, f);
  std::vector<std::size_t> order, old_position;  // function in space, member it was
  std::vector<char> taken(space.functions.size(), 0);
  std::size_t unchanged = 0;
  for (std::size_t i = 0; i < members.size(); ++i) {
    const auto found = index_of_key.find(members[i].key);
    if (found == index_of_key.end() || taken[found->second]) continue;
    if (order.size() == i) unchanged = i + 1;
    taken[found->second] = 1;
    order.push_back(found->second);
    old_position.push_back(i);
  }
  const std::size_t kept = order.size();
  std::vector<std::size_t> wanted;
  for (std::size_t f = 0; f < space.functions.size(); ++f)
    if (!taken[f]) wanted.push_back(f);
  order.insert(order.end(), wanted.begin(), wanted.end());

  std::vector<Member> now;
  DenseMatrix now_among(3 * order.size(), 3 * order.size());
  for (std::size_t i = 0; i < kept; ++i) {
    now.push_back(std::move(members[old_position[i]]));
    now.back().node = space.functions[order[i]].node;
    for (std::size_t j = 0; j < kept; ++j)
      for (int p = 0; p < 3; ++p)
        for (int q = 0; q < 3; ++q)
          now_among(3 * i + p, 3 * j + q) = among(3 * old_position[i] + p, 3 * old_position[j] + q);
  }
  std::vector<EnrichmentRows> rows = stored_rows({*body, load}, space, wanted, store);
  for (std::size_t w = 0; w < wanted.size(); ++w) {
    const EnrichmentFunction& f = space.functions[wanted[w]];
    Member member{f.kind, f.node,       f.key, std::move(rows[w].D_body), std::move(rows[w].K),
                  {},     rows[w].load, {}};
    DenseMatrix columns = transposed(member.K);
    body->solve_single_layer(columns.data.data(), 3);
    member.VinvK = transposed(columns);
    add_transposed_product(member.K, body->VinvK(), member.coupling);
    reduce_load(member);
    for (const PanelValues& v : f.support)
      if (v.panel >= space.surface_count)
        member.normal += space.panels[v.panel].area * space.panels[v.panel].normal;
    if (f.carries_opening()) member.normal.normalize();
    now.push_back(std::move(member));
  }
  for (std::size_t w = 0; w < wanted.size(); ++w)
    for (std::size_t j = 0; j < order.size(); ++j) {
      DenseMatrix block(3, 3);
      for (int p = 0; p < 3; ++p)
        for (int q = 0; q < 3; ++q)
          block(p, q) = rows[w].D_enriched(p, 3 * order[j] + q);
      add_transposed_product(now[kept + w].K, now[j].VinvK, block);
      for (int p = 0; p < 3; ++p)
        for (int q = 0; q < 3; ++q) {
          now_among(3 * (kept + w) + p, 3 * j + q) = block(p, q);
          now_among(3 * j + q, 3 * (kept + w) + p) = block(p, q);
        }
    }
  member_of.resize(order.size());
  for (std::size_t i = 0; i < order.size(); ++i)
    member_of[order[i]] = i;
  members = std::move(now);
  among = std::move(now_among);
  factored = std::min(factored, unchanged);
  P.truncate(body_size() + 3 * factored);
  statistics = {members.size(), wanted.size(), members.size() - factored};
}

void CrackedBody::State::eliminate_members() {
  const std::size_t n = body_size(), old_size = n + 3 * factored, count = 3 * (members.size() - factored);
  std::vector<double> coupling(count * old_size), diagonal(count * count);
  for (std::size_t i = 0; i < count; ++i) {
    const Member& member = members[factored + i / 3];
    std::copy_n(member.coupling.data.data() + (i % 3) * n, n, coupling.data() + i * old_size);
    const double* row = among.data.data() + (3 * factored + i) * among.columns;
    std::copy_n(row, 3 * factored, coupling.data() + i * old_size + n);
    std::copy_n(row + 3 * factored, count, diagonal.data() + i * count);
  }
  if (!P.append(coupling, diagonal))
    throw SingularSystem(
        "the cracked body's stiffness is not positive definite: a piece has come off, or the crack mesh "
        "touches itself");
  factored = members.size();
}

CrackedBody::CrackedBody(std::shared_ptr<const BodyOperator> body, LoadCase load)
    : state_(std::make_unique<State>(std::move(body), std::move(load))) {}
CrackedBody::~CrackedBody() = default;
CrackedBody::CrackedBody(CrackedBody&&) noexcept = default;
CrackedBody& CrackedBody::operator=(CrackedBody&&) noexcept = default;

void CrackedBody::keep_rows(RowStore* store) {
  state_->store = store;
}

void CrackedBody::set_crack(const CutComplex& cut) {
  state_->cut_nodes = cut.positions.size();
  state_->space = make_enriched_space(cut, state_->surface(), state_->body->kinds());
  state_->replace_members();
  state_->eliminate_members();
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

void CrackedBody::solve() {
  State& s = *state_;
  s.solution = s.body_load;
  std::vector<OpeningConstraint> constraints;
  for (const Member& member : s.members) {
    if (member.kind != EnrichmentKind::hat) constraints.push_back({s.solution.size(), member.normal});
    for (int p = 0; p < 3; ++p)
      s.solution.push_back(member.load[p]);
  }
  s.P.solve(s.solution.data());
  if (s.body->settings().contact)
    close_penetrating_faces(s.solution, constraints,
                            [&](double* b, std::size_t count) { s.P.solve(b, count); });
  s.opening.assign(s.cut_nodes, Vec3::Zero());
  for (std::size_t i = 0; i < s.members.size(); ++i)
    if (s.members[i].kind != EnrichmentKind::hat) s.opening[s.members[i].node] = s.coefficient(i);
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

// q = V⁻¹ (f_D + K u + K_a a)
std::vector<Vec3> CrackedBody::State::computed_traction() const {
  std::vector<Vec3> t = load.traction;
  std::vector<double> q = VinvF;
  for (std::size_t i = 0; i < q.size(); ++i) {
    for (std::size_t j = 0; j < body_size(); ++j)
      q[i] += body->VinvK()(i, j) * solution[j];
    for (std::size_t a = 0; a < members.size(); ++a)
      for (int p = 0; p < 3; ++p)
        q[i] += members[a].VinvK(i, p) * coefficient(a)[p];
  }
  for (std::size_t x = 0; x < t.size(); ++x)
    if (const int at = unknowns().traction[x]; at >= 0)
      t[x] = Eigen::Map<const Vec3>(&q[3 * static_cast<std::size_t>(at)]);
  return t;
}

std::vector<Vec3> CrackedBody::traction() const {
  const State& s = *state_;
  std::vector<Vec3> t = s.computed_traction();
  if (s.load.ambient.stress)
    for (std::size_t x = 0; x < t.size(); ++x)
      t[x] += s.load.ambient.stress(s.body->blocks().panels[x].center) * s.body->blocks().panels[x].normal;
  return t;
}

// Every panel after the cut with its traction and density.
std::vector<LoadedPanel> CrackedBody::loaded_panels() const {
  const State& s = *state_;
  const IdVector<NodeId, Vec3> u = s.computed_displacement();
  const std::vector<Vec3> t = s.computed_traction();
  std::vector<LoadedPanel> panels;
  for (std::size_t x = 0; x < s.space.panels.size(); ++x) {
    LoadedPanel p{s.space.panels[x], Vec3::Zero(), {Vec3::Zero(), Vec3::Zero(), Vec3::Zero()}};
    if (x < s.space.surface_count) {
      p.traction = t[s.space.parent[x].index()];
      const auto& nodes = s.surface().corners[s.space.parent[x]];
      for (int k = 0; k < 3; ++k)
        for (int j = 0; j < 3; ++j)
          p.density[k] += s.space.parent_values[x][k][j] * u[nodes[j]];
    }
    panels.push_back(std::move(p));
  }
  for (std::size_t f = 0; f < s.space.functions.size(); ++f)
    for (const PanelValues& v : s.space.functions[f].support)
      for (int k = 0; k < 3; ++k)
        panels[v.panel].density[k] += v.w[k] * s.coefficient(s.member_of[f]);
  return panels;
}

std::vector<Mat3> CrackedBody::surface_stress() const {
  const State& s = *state_;
  std::vector<Mat3> stress(s.surface().triangle_count(), Mat3::Zero());
  const std::vector<LoadedPanel> panels = loaded_panels();
  for (std::size_t x = 0; x < s.space.surface_count; ++x) {
    const std::size_t parent = s.space.parent[x].index();
    const Panel& p = panels[x].panel;
    Mat3 value = conchoid::surface_stress(p.x, panels[x].density, panels[x].traction, s.body->material());
    if (s.load.ambient.stress) value += s.load.ambient.stress(p.center);
    stress[parent] += p.area / s.body->blocks().panels[parent].area * value;
  }
  return stress;
}

Mat3 CrackedBody::interior_stress(const Vec3& x) const {
  const Mat3 computed = conchoid::interior_stress(x, loaded_panels(), state_->body->material());
  return state_->load.ambient.stress ? Mat3(computed + state_->load.ambient.stress(x)) : computed;
}

std::vector<CrackFaceStress> CrackedBody::crack_face_stress(const std::vector<TriId>& pieces) const {
  constexpr double off_the_face = 0.4;  // in edges of the triangle
  const State& s = *state_;
  const std::vector<LoadedPanel> panels = loaded_panels();
  std::vector<CrackFaceStress> out(pieces.size());
  parallel_for(pieces.size(), 1, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      const LoadedPanel& face = panels[s.space.surface_count + pieces[i].index()];
      const Panel& p = face.panel;
      const Vec3 off = off_the_face * std::sqrt(2 * p.area) * p.normal;
      const auto mean_at = [&](double times) -> Mat3 {
        return 0.5 * (conchoid::interior_stress(p.center + times * off, panels, s.body->material()) +
                      conchoid::interior_stress(p.center - times * off, panels, s.body->material()));
      };
      Mat3 base = 2 * mean_at(1) - mean_at(2);
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
  });
  return out;
}

const AppendStatistics& CrackedBody::statistics() const {
  return state_->statistics;
}

double CrackedBody::energy() const {
  const State& s = *state_;
  double work = std::inner_product(s.body_load.begin(), s.body_load.end(), s.solution.begin(), 0.0);
  for (std::size_t i = 0; i < s.members.size(); ++i)
    for (int p = 0; p < 3; ++p)
      work += s.members[i].load[p] * s.solution[s.body_size() + 3 * i + p];
  return 0.5 * work;
}

CrackedBody make_cracked_body(TriMesh surface, const BoundaryData& data, const ElasticConstants& m,
                              AmbientField ambient, const BemSettings& settings) {
  LoadCase load = load_case(surface, data, std::move(ambient));
  return CrackedBody(make_body_operator(std::move(surface), data, m, settings), std::move(load));
}

CutComplex uncut_sheet(const TriMesh& sheet) {
  CutComplex cut;
  cut.positions = sheet.positions;
  for (std::size_t i = 0; i < sheet.node_count(); ++i)
    cut.sheet_node.push_back(NodeId(i));
  cut.sheet = sheet.corners;
  for (std::size_t t = 0; t < sheet.triangle_count(); ++t)
    cut.sheet_parent.push_back(TriId(t));
  return cut;
}

CutComplex whole_surface(const TriMesh& surface) {
  CutComplex cut;
  cut.positions = surface.positions;
  cut.surface_node_count = surface.node_count();
  cut.sheet_node.assign(surface.node_count(), NodeId{});
  cut.surface = surface.corners;
  for (std::size_t t = 0; t < surface.triangle_count(); ++t)
    cut.surface_parent.push_back(TriId(t));
  return cut;
}

}  // namespace conchoid
