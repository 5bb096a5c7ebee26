#include "conchoid/sim/frame_loop.hpp"
#include "conchoid/crack/closing/advance_fronts.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "conchoid/bem/rigid_body.hpp"
#include "conchoid/bem/surface_stress.hpp"
#include "conchoid/core/error.hpp"
#include "conchoid/core/interrupt.hpp"
#include "conchoid/core/log.hpp"
#include "conchoid/core/progress.hpp"
#include "conchoid/crack/law/criterion.hpp"
#include "conchoid/crack/law/initiation.hpp"
#include "conchoid/intersect/unfold.hpp"
#include "conchoid/sim/methods.hpp"
#include "conchoid/surface/separation.hpp"

namespace conchoid {
namespace {

constexpr double kAlongSurface = 0.9;  // cosine between σ1 and the surface normal above which no crack starts
// × r̄: openings beyond it, a triangle behind the front, say nothing in linear elasticity: a piece hangs by a
// thread. No sample is taken from them, and the thread breaks straight ahead.
constexpr double kLargestOpening = 3;
constexpr double kAlongFace = 0.5;        // the same at the face of a crack
constexpr int kMostCarried = 8;           // frames in a row without a solution; by then nothing will come off
constexpr double kLigamentIntensity = 3;  // × K_c, at ligaments narrower than a triangle
constexpr double kDrivingSpacing = 1.0 / 10;  // × r̄: of the markers that move the cracks
constexpr double kSameSpacing = 1e-6;         // spacings that differ by less are the same

CrackSheet initial_sheet(const BodySetup& setup) {
  CrackSheet sheet;
  for (const TriMesh& crack : setup.cracks)
    append_part(sheet, oriented_like(sheet, crack));
  return sheet;
}

std::unique_ptr<OpeningSource> make_predictor(const Scene& scene, const RunOptions& options, BemOpening& bem,
                                              const BodySetup& setup) {
  return checked_method(options.method, options.regressor)
      .make({bem, scene.material, setup, sif_settings(scene.run), options.regressor});
}

struct WeakPoint {
  Vec3 position;
  double strength;
};

// The point of least strength in a triangle, among evenly spread ones.
WeakPoint weakest_point(const Triangle& x, double strength, const MaterialField& field) {
  constexpr int kParts = 8;
  WeakPoint weakest{Vec3::Zero(), std::numeric_limits<double>::infinity()};
  for (int i = 0; i < kParts; ++i)
    for (int j = 0; i + j < kParts; ++j) {
      const double a = (i + 1.0 / 3) / kParts, b = (j + 1.0 / 3) / kParts;
      const Vec3 at = a * x[0] + b * x[1] + (1 - a - b) * x[2];
      const double here = strength * field.at(at).value;
      if (here < weakest.strength) weakest = {at, here};
    }
  return weakest;
}

// Candidates for branches: faces of the crack's whole triangles away from its fronts.
std::vector<InitiationCandidate> find_branches(const BodySetup& setup, const CrackState& crack,
                                               const CrackedBody& body, double strength,
                                               const std::vector<Vec3>& front_nodes, double distance) {
  const auto whole = [&](const std::array<NodeId, 3>& c) {
    return std::all_of(c.begin(), c.end(), [&](NodeId n) {
      const NodeId of_sheet = crack.cut.sheet_node[n];
      return of_sheet.valid() && crack.node_in_cut[of_sheet] == n;
    });
  };
  std::vector<TriId> faces;
  for (std::size_t t = 0; t < crack.cut.sheet.size(); ++t) {
    const Vec3 x = centroid(crack.trimmed, TriId(t));
    if (whole(crack.cut.sheet[TriId(t)]) &&
        std::none_of(front_nodes.begin(), front_nodes.end(),
                     [&](const Vec3& y) { return (y - x).squaredNorm() < distance * distance; }))
      faces.push_back(TriId(t));
  }
  const std::vector<CrackFaceStress> stress = body.crack_face_stress(faces);
  const Vec3 center = setup.infinite() ? Vec3(Vec3::Zero()) : bounding_box(setup.surface).center();
  std::vector<InitiationCandidate> out;
  for (std::size_t i = 0; i < faces.size(); ++i) {
    auto nodes = crack.cut.sheet[faces[i]];
    std::sort(nodes.begin(), nodes.end());
    const Vec3 n = unit_normal(crack.trimmed, faces[i]), x = centroid(crack.trimmed, faces[i]);
    const double local_strength = strength * setup.strength.at(x).value;
    for (const double side : {1.0, -1.0}) {
      const PrincipalStress p = principal_stress(side > 0 ? stress[i].plus : stress[i].minus);
      if (p.value[0] <= local_strength || std::abs(p.direction.col(0).dot(n)) > kAlongFace) continue;
      const TriId id(setup.surface.triangle_count() + 2 * faces[i].index() + (side > 0 ? 0 : 1));
      const auto& y = crack.cut.positions;
      out.push_back({x,
                     p.value[0],
                     p.direction.col(0),
                     side * n,
                     local_strength,
                     id,
                     {y[nodes[0]], y[nodes[1]], y[nodes[2]]},
                     (x - center).norm(),
                     true});
    }
  }
  return out;
}

// Candidates for new cracks: free triangles that no crack cuts, pulled across rather than along their normal.
std::vector<InitiationCandidate> find_candidates(const BodySetup& setup, const CrackState& crack,
                                                 const CrackedBody& body, double strength) {
  std::vector<char> cut(setup.surface.triangle_count(), 0);
  for (std::size_t t = 0, n = 0; t < crack.cut.surface.size(); ++t) {
    const std::size_t parent = crack.cut.surface_parent[t].index();
    n = t > 0 && crack.cut.surface_parent[t - 1].index() == parent ? n + 1 : 0;
    if (n > 0) cut[parent] = 1;
  }
  const Vec3 center = bounding_box(setup.surface).center();
  std::vector<InitiationCandidate> out;
  const std::vector<Mat3> stress = body.surface_stress();
  for (std::size_t t = 0; t < stress.size(); ++t) {
    if (cut[t] || setup.data.kind[t] == BoundaryKind::displacement) continue;
    const PrincipalStress p = principal_stress(stress[t]);
    const Vec3 n = unit_normal(setup.surface, TriId(t));
    if (std::abs(p.direction.col(0).dot(n)) > kAlongSurface) continue;
    auto nodes = setup.surface.corners[TriId(t)];
    std::sort(nodes.begin(), nodes.end());
    const auto& x = setup.surface.positions;
    const auto [at, local_strength] =
        setup.strength.homogeneous()
            ? WeakPoint{centroid(setup.surface, TriId(t)), strength}
            : weakest_point({x[nodes[0]], x[nodes[1]], x[nodes[2]]}, strength, setup.strength);
    if (p.value[0] <= local_strength) continue;
    out.push_back({at,
                   p.value[0],
                   p.direction.col(0),
                   -n,
                   local_strength,
                   TriId(t),
                   {x[nodes[0]], x[nodes[1]], x[nodes[2]]},
                   (at - center).norm()});
  }
  return out;
}

}  // namespace

struct FrameLoop::Clock {
  std::chrono::steady_clock::time_point last = std::chrono::steady_clock::now();
  double lap() {
    const auto now = std::chrono::steady_clock::now();
    const double seconds = std::chrono::duration<double>(now - last).count();
    last = now;
    return seconds;
  }
};

FrameLoop::FrameLoop(const Scene& scene, const RunOptions& options)
    : scene_(scene),
      options_(options),
      m_(scene.material.elastic()),
      setup_(set_up_body(scene)),
      bem_(setup_, m_, sif_settings(scene.run), {scene.run.quadrature_tolerance, scene.run.contact}),
      predictor_(make_predictor(scene, options, bem_, setup_)),
      history_(scene.material, setup_.toughness, setup_.crack_edge),
      crack_{initial_sheet(setup_), {}, {}, {}, {}, {}},
      fine_(crack_.sheet, {.resolution = setup_.crack_edge, .spacing = kDrivingSpacing * setup_.crack_edge}),
      rayleigh_speed_(rayleigh_speed(
          m_, scene.material.density,
          scene.run.exact_rayleigh_speed ? RayleighFormula::exact : RayleighFormula::published)) {
  crack_.cut = whole_surface(setup_.surface);
  if (std::abs(setup_.surface_edge / setup_.crack_edge / kDrivingSpacing - 1) > kSameSpacing)
    visible_.emplace(crack_.sheet,
                     FineFrontSettings{.resolution = setup_.crack_edge, .spacing = setup_.surface_edge});
  toughness_ = [this, K_c = scene.material.toughness](const Vec3& x) {
    const FieldSample factor = setup_.toughness.at(x);
    return Toughness{K_c * factor.value, K_c * factor.gradient};
  };
}

// One new crack at a time, where the stress as last solved exceeds the strength most: on the body's surface,
// or as a branch on the face of a crack.
void FrameLoop::start_cracks(RunResult& result) {
  if (started_ >= scene_.run.max_cracks) return;
  const auto& x = crack_.sheet.mesh.positions;
  const std::vector<Vec3> taken(x.begin(), x.end());
  std::vector<Vec3> fronts;
  for (const SheetFront& front : crack_.sheet.fronts)
    for (const NodeId n : front.nodes)
      fronts.push_back(x[n]);
  const InitiationSettings settings{setup_.crack_edge, 2 * setup_.crack_edge, 1};
  const double strength = scene_.material.strength;
  std::vector<InitiationCandidate> candidates =
      find_branches(setup_, crack_, bem_.body(), strength, fronts, settings.min_distance);
  if (!setup_.infinite()) {
    const auto on_surface = find_candidates(setup_, crack_, bem_.body(), strength);
    candidates.insert(candidates.end(), on_surface.begin(), on_surface.end());
  }
  for (const CrackSite& site : choose_sites(candidates, taken, settings, fronts)) {
    append_part(crack_.sheet, oriented_like(crack_.sheet, disc_sheet(site)));
    ++started_;
    ++result.cracks;
  }
  fine_.append_parts(crack_.sheet);
  if (visible_) visible_->append_parts(crack_.sheet);
}

// What every point is about to do, its line in front.csv, and the samples that pair it with the frame before.
std::vector<FrontStep> FrameLoop::record_and_step(int frame, const std::vector<FrontOpening>& openings,
                                                  RunResult& result) {
  std::vector<FrontStep> steps;
  largest_intensity_ = 0;
  for (std::size_t i = 0; i < crack_.points.size(); ++i) {
    const FrontPoint& point = crack_.points[i];
    const FrontOpening& o = openings[i];
    const FrontFrame& f = point.frame;
    const Vec3 K = scene_.run.published_compression
                       ? with_compressive_factor(o.intensity, scene_.material.compressive_factor)
                       : o.intensity;
    const double K_eff = effective_intensity(K, m_);
    const bool arrested = crack_.sheet.state[point.node] == FrontState::arrested;
    const double K_c = toughness_(crack_.sheet.mesh.positions[point.node]).value;
    const double length = arrested ? 0 : advance_length(K_eff, K_c, setup_.crack_edge);
    const bool thread = opening_from_intensity(o.intensity, setup_.crack_edge, m_).norm() >
                        kLargestOpening * setup_.crack_edge;
    const double angle = thread ? 0 : kink_angle(K, m_);
    largest_intensity_ = std::max(largest_intensity_, K_eff);
    // Where the toughness varies every marker decides for itself.
    if (length > 0 || (!arrested && K_eff > 0 && !setup_.toughness.homogeneous()))
      steps.push_back({point.node, f, angle, K_eff});
    FrontRow row;
    row.frame = frame;
    row.front = point.front;
    row.node = point.node.value;
    row.position = crack_.sheet.mesh.positions[point.node] + setup_.origin;
    row.intensity = o.intensity;
    row.opening = {o.opening.dot(f.e1), o.opening.dot(f.e2), o.opening.dot(f.e3)};
    row.speed = rayleigh_speed_ * length / setup_.crack_edge;
    row.kink_angle = angle;
    result.front.push_back(row);
    result.largest_growth = std::max(result.largest_growth, crack_.sheet.travelled[point.node]);
    if (auto sample = solved() ? history_.sample(crack_, point) : std::nullopt) {
      const FrontFrame& before = history_.find(point.correlation)->frame;
      sample->opening = {o.opening.dot(before.e1), o.opening.dot(before.e2), o.opening.dot(before.e3)};
      const double size = o.opening.norm();
      if (size > 0 && size < kLargestOpening * setup_.crack_edge) result.samples.add(*sample);
    }
    if (!o.in_range && !warned_) {
      warned_ = true;
      result.document.warnings.push_back(fmt::format(
          "frame {}: the regressor is asked beyond its training data (K_I = {:.3g}, K_II = {:.3g}, "
          "K_III = {:.3g} Pa√m); train it on a database that covers such loads",
          frame, o.intensity[0], o.intensity[1], o.intensity[2]));
      warning(result.document.warnings.back());
    }
  }
  if (!predictor_) history_.remember(crack_, openings);
  for (const FrontPoint& point : ligament_points(crack_))
    steps.push_back(
        {point.node, point.frame, 0,
         std::max(largest_intensity_,
                  kLigamentIntensity * toughness_(crack_.sheet.mesh.positions[point.node]).value)});
  return steps;
}

void FrameLoop::write_frame(int frame, RunFolder& folder, const std::vector<FrontOpening>& openings) {
  FrameData data;
  data.time = frame * setup_.crack_edge / rayleigh_speed_;
  data.body = setup_.surface;
  data.crack = crack_.trimmed;
  for (TriMesh* mesh : {&data.body, &data.crack})
    for (Vec3& x : mesh->positions)
      x += setup_.origin;
  data.intensity.assign(data.crack.node_count(), Vec3::Zero());
  data.opening.assign(data.crack.node_count(), Vec3::Zero());
  for (std::size_t i = 0; i < crack_.points.size(); ++i) {
    data.intensity[crack_.node_in_cut[crack_.points[i].node]] = openings[i].intensity;
    if (const NodeId c = crack_.points[i].correlation; c.valid() && crack_.node_in_cut[c].valid())
      data.opening[crack_.node_in_cut[c]] = openings[i].opening;
  }
  const bool solved = predictor_ ? frame == 1 : this->solved();
  if (solved) data.opening = bem_.body().opening();
  if (solved && !setup_.infinite()) {
    data.displacement = bem_.body().displacement();
    for (const Vec3& t : bem_.body().traction())
      data.traction.push_back(t);
    for (const Mat3& s : bem_.body().surface_stress()) {
      data.stress.push_back(s);
      data.principal_stress.push_back(principal_stress(s).value);
    }
  }
  data.exaggeration = scene_.output.exaggeration;
  folder.write_frame(frame, data);
}

// A failure in a later frame ends the run but keeps what it has: mostly a piece that hangs by a ligament too
// thin to resolve.
std::string FrameLoop::guarded_frame(int frame, RunResult& result, RunFolder* folder) {
  try {
    return compute_frame(frame, result, folder);
  } catch (const std::runtime_error& error) {
    if (frame == 1) throw;
    result.document.warnings.push_back(
        fmt::format("frame {}: {}; the run ends here and keeps the frames before", frame, error.what()));
    warning(result.document.warnings.back());
    return "singular";
  }
}

std::vector<FrontOpening> FrameLoop::open(FrameRecord& record, RunResult& result) {
  if (predictor_) return predictor_->open(crack_);
  try {
    std::vector<FrontOpening> openings = bem_.open(crack_);
    carried_ = 0;
    return openings;
  } catch (const ComputationError& error) {
    if (record.frame == 1 || carried_ == kMostCarried) throw;
    if (carried_++ == 0) {
      result.document.warnings.push_back(fmt::format(
          "frame {}: {}; the front goes straight on with K as last solved", record.frame, error.what()));
      warning(result.document.warnings.back());
    }
    record.source = "carried";
    return carried_openings(crack_, history_, m_);
  }
}

std::string FrameLoop::compute_frame(int frame, RunResult& result, RunFolder* folder) {
  RunDocument& doc = result.document;
  Clock clock;
  FrameRecord record;
  record.frame = frame;
  record.source = predictor_ && frame > 1 ? predictor_->name() : "bem";
  record.front_nodes = crack_.points.size();
  const std::vector<FrontOpening> openings = open(record, result);
  record.opening_seconds = clock.lap();
  doc.frames = frame;
  const std::vector<FrontStep> steps = record_and_step(frame, openings, result);
  const std::size_t fronts_before = crack_.sheet.fronts.size();
  if (folder) write_frame(frame, *folder, openings);
  record.other_seconds = clock.lap();
  if (solved()) start_cracks(result);
  const bool new_crack = crack_.sheet.fronts.size() > fronts_before;
  const std::size_t before = fine_.surface().triangle_count() + crack_.sheet.mesh.triangle_count();
  if (!steps.empty())
    advance_fronts(crack_.sheet, fine_, with_drawn_nodes(crack_.sheet, steps), toughness_, setup_.crack_edge,
                   visible_ ? &*visible_ : nullptr);
  if (!steps.empty() || new_crack) update_crack(crack_, setup_.surface, setup_.crack_edge);
  record.fracture_seconds = clock.lap();
  record.crack_triangles = crack_.trimmed.triangle_count();
  record.max_K_eff = largest_intensity_;
  doc.opening_seconds += record.opening_seconds;
  doc.fracture_seconds += record.fracture_seconds;
  doc.timings.push_back(record);
  const bool grown = fine_.surface().triangle_count() + crack_.sheet.mesh.triangle_count() > before;
  const bool moved = setup_.toughness.homogeneous() ? !steps.empty() : grown;
  return !moved && !new_crack ? "arrested" : "frame-limit";
}

void FrameLoop::run(RunResult& result, RunFolder* folder, Checkpoint* checkpoint) {
  RunDocument& doc = result.document;
  const int limit = options_.frames.value_or(scene_.run.frames);
  result.cracks = static_cast<int>(setup_.cracks.size());
  std::optional<Progress> progress;
  if (options_.progress) progress.emplace("frames", static_cast<std::size_t>(limit));
  bem_.keep_rows(checkpoint);
  Clock clock;
  if (result.cracks == 0 && scene_.run.max_cracks > 0) {
    bem_.solve(crack_.cut);
    doc.opening_seconds += clock.lap();
    start_cracks(result);
  }
  doc.stop = crack_.sheet.fronts.empty() ? "intact" : "frame-limit";
  if (crack_.sheet.fronts.empty()) return;
  update_crack(crack_, setup_.surface, setup_.crack_edge);
  for (int frame = 1; frame <= limit && doc.stop == "frame-limit"; ++frame) {
    if (interrupted()) {
      doc.stop = "interrupted";
    } else if (!setup_.infinite() && separates(crack_.cut)) {
      doc.stop = "separated";
    } else {
      if (checkpoint) checkpoint->begin(frame);
      doc.stop = guarded_frame(frame, result, folder);
      if (checkpoint) checkpoint->finish(frame);
    }
    if (progress) progress->advance();
  }
  if (doc.stop == "frame-limit" && !setup_.infinite() && separates(crack_.cut)) doc.stop = "separated";
  (visible_ ? *visible_ : fine_).finish();
}

std::vector<TriMesh> FrameLoop::fine_sheets() const {
  const TriMesh& all = (visible_ ? *visible_ : fine_).surface();
  const std::vector<int> part = connected_parts(all);
  std::vector<TriMesh> sheets(part.empty() ? 0 : 1 + *std::max_element(part.begin(), part.end()));
  std::vector<NodeId> moved(all.node_count());
  for (std::size_t i = 0; i < all.node_count(); ++i)
    moved[i] = sheets[part[i]].positions.add(all.positions[NodeId(i)]);
  for (const auto& c : all.corners)
    sheets[part[c[0].index()]].corners.push_back(
        {moved[c[0].index()], moved[c[1].index()], moved[c[2].index()]});
  for (TriMesh& sheet : sheets)
    sheet = unfolded_part(sheet);
  std::erase_if(sheets, [](const TriMesh& sheet) { return sheet.corners.empty(); });
  return sheets;
}

}  // namespace conchoid
