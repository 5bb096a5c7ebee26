#include "conchoid/sim/fracture.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <numeric>

#include "conchoid/core/error.hpp"
#include "conchoid/core/interrupt.hpp"
#include "conchoid/core/stopwatch.hpp"
#include "conchoid/crack/closing/advance_fronts.hpp"
#include "conchoid/crack/law/criterion.hpp"
#include "conchoid/crack/law/hoop_stress_law.hpp"
#include "conchoid/sim/clamp_edges.hpp"
#include "conchoid/sim/crack_sites.hpp"
#include "conchoid/sim/ligament_rule.hpp"
#include "conchoid/sim/parting.hpp"
#include "conchoid/sim/path_turn.hpp"
#include "conchoid/sim/resolution_warnings.hpp"
#include "conchoid/sim/resolved_points.hpp"
#include "conchoid/sim/swept_sheets.hpp"

namespace conchoid {
namespace {

constexpr int kMostCarried = 8;           // frames in a row without a solution; by then nothing will come off
constexpr double kLigamentIntensity = 3;  // × K_c, at ligaments narrower than a triangle
constexpr double kLargestCrumb = 1e-2;    // × the body

CrackSheet initial_sheet(const PreparedBody& body) {
  CrackSheet sheet;
  for (const TriMesh& crack : body.cracks)
    append_part(sheet, oriented_like(sheet, crack));
  return sheet;
}

std::shared_ptr<const GrowthLaw> hoop_stress_law(const MaterialSpec& material, const RunSpec& run) {
  const auto factor =
      run.published_compression ? std::optional(material.compressive_factor) : std::optional<double>();
  return std::make_shared<HoopStressLaw>(material.elastic(), factor);
}

ToughnessField toughness_field(const PreparedBody& body) {
  return [field = body.toughness, K_c = body.material.toughness](const Vec3& x) {
    const FieldSample factor = field.at(x);
    return Toughness{K_c * factor.value, K_c * factor.gradient};
  };
}

}  // namespace

// On the heap and never moved: its parts refer to each other.
struct Fracture::State {
  std::shared_ptr<const PreparedBody> body;
  RunSpec settings;
  ElasticConstants m;
  BemOpening bem;
  std::unique_ptr<OpeningSource> predictor;  // none: bem itself
  FrontHistory history;
  CrackState crack;
  SweptSheets sheets;
  Parting parting;
  GrowthModel growth;
  double rayleigh_speed;
  std::vector<FractureObserver*> observers;

  std::size_t given_nodes;  // of the cracks that the body had
  bool started = false;
  int before = 0;  // frames of bodies that this one is a piece of
  int frame = 0;   // these counted, too
  std::optional<StopReason> stop;
  std::vector<FrontOpening> openings;
  std::vector<FrontDecision> decisions;
  int new_cracks = 0;   // that started in the run
  int carried = 0;      // frames in a row that could not be solved
  bool warned = false;  // of predictions beyond the training

  State(std::shared_ptr<const PreparedBody> prepared, LoadCase loads, const RunSpec& run,
        const MakeOpeningSource& source, std::shared_ptr<const GrowthLaw> law)
      : body(std::move(prepared)),
        settings(run),
        m(body->material.elastic()),
        bem(body->elastic, std::move(loads), sif_settings(run)),
        predictor(source ? source(bem) : nullptr),
        history(body->material, body->toughness, body->crack_edge),
        crack{initial_sheet(*body), {}, {}, {}, {}, {}},
        sheets(crack.sheet, body->crack_edge, body->surface_edge),
        parting(*body, settings),
        growth{law ? std::move(law) : hoop_stress_law(body->material, run), toughness_field(*body)},
        rayleigh_speed(conchoid::rayleigh_speed(
            m, body->material.density,
            run.exact_rayleigh_speed ? RayleighFormula::exact : RayleighFormula::published)),
        given_nodes(crack.sheet.mesh.node_count()) {
    crack.cut = whole_surface(body->surface);
  }

  OpeningSource& source() { return predictor ? *predictor : static_cast<OpeningSource&>(bem); }
  bool solves_next() const { return !predictor || predictor->solves(crack.sheet.frame); }
  bool solved() const { return carried == 0 && (!predictor || predictor->solved()); }
  // A prediction knows nothing of cracks that start later, unless it is solved now and then.
  bool may_start_cracks() const { return solved() && (!predictor || predictor->solves_later_frames()); }
  bool ligament_breaks(bool at_end) {
    return parting.by_ligament({crack, openings, decisions, m, body->crack_edge, carried > 0}, sheets, frame,
                               at_end);
  }
  bool separated() { return parting.by_cracks(crack, sheets, frame); }
  bool first(int number) const { return number <= before + 1; }

  void start(StepReport& report);
  bool start_crack(StepReport& report);
  void start_cracks(StepReport& report);
  void compute_openings(StepReport& report);
  std::vector<FrontOpening> open_crack();
  std::vector<FrontStep> decide(StepReport& report);
  std::vector<FrontStep> open(StepReport& report, Stopwatch& clock);
  void grow(const std::vector<FrontStep>& steps, StepReport& report, Stopwatch& clock);
  void attempt(StepReport& report, const std::function<void()>& part);
  void compute_frame(const Fracture& self, StepReport& report);
};

// A new crack where the stress as last solved exceeds the strength most. Whether there is one.
bool Fracture::State::start_crack(StepReport& report) {
  const std::vector<CrackSite> sites = find_crack_sites(*body, crack, bem.body(), 1);
  if (sites.empty()) return false;
  append_part(crack.sheet, oriented_like(crack.sheet, disc_sheet(sites[0])));
  ++new_cracks;
  for (const auto& said : {clamp_warning(*body, sites[0].center), outline_warning(*body, sites[0].center)})
    if (said) report.warnings.push_back(*said);
  if (report.new_cracks++ == 0) report.start = {sites[0].severity, sites[0].center};
  sheets.append_parts();
  return true;
}

// Several in one frame: the body is solved again after each, so that the next one feels how far it relieves
// the stress around it. Where that cannot be solved no more start.
void Fracture::State::start_cracks(StepReport& report) try {
  for (int i = 0; i < settings.max_cracks_per_frame && new_cracks < settings.max_cracks; ++i) {
    if (i > 0) {
      update_crack(crack, body->surface, body->crack_edge);
      bem.solve(crack.cut, crack.division);
    }
    if (!start_crack(report)) return;
  }
} catch (const SingularSystem&) {  // with the crack just started: it is the last one of this frame
}

void Fracture::State::start(StepReport& report) {
  started = true;
  Stopwatch clock;
  if (body->cracks.empty() && settings.max_cracks > 0) {
    bem.solve(crack.cut);
    report.start_seconds = clock.lap();
    start_cracks(report);
  }
  if (crack.sheet.fronts.empty()) {
    stop = StopReason::intact;
    return;
  }
  update_crack(crack, body->surface, body->crack_edge);
  if (separated()) stop = StopReason::separated;
}

// A crumb that has come off the boundary elements, though not off the body, leaves their system singular.
std::vector<FrontOpening> Fracture::State::open_crack() try {
  return source().open(crack);
} catch (const SingularSystem&) {
  if (!hold_crumbs(crack, kLargestCrumb * enclosed_volume(body->surface))) throw;
  return source().open(crack);
}

// A later frame whose system is singular is carried, a few times in a row.
void Fracture::State::compute_openings(StepReport& report) {
  try {
    openings = open_crack();
    carried = 0;
    report.source = solved() ? bem.name() : source().name();
    if (const ContactReport& contact = bem.body().contact(); solved() && !contact.converged)
      report.warnings.push_back(fmt::format("frame {}: {}", report.frame, contact_warning(contact)));
  } catch (const SingularSystem& error) {
    if (first(report.frame) || carried == kMostCarried) throw;
    if (carried++ == 0)
      report.warnings.push_back(fmt::format("frame {}: {}; the front goes straight on with K as last solved",
                                            report.frame, error.what()));
    report.source = "carried";
    openings = carried_openings(crack, history, *growth.law);
    source().take_carried(crack, openings);
  }
  report.expected_error = source().expected_error();
}

// What every point is about to do.
std::vector<FrontStep> Fracture::State::decide(StepReport& report) {
  const double r = body->crack_edge;
  std::vector<FrontStep> steps;
  decisions.clear();
  const PathSoFar path{history, *growth.law, crack.sheet, given_nodes};
  const std::vector<FrontResolution> resolved = resolve_points(crack, openings, growth.toughness, m);
  for (std::size_t i = 0; i < crack.points.size(); ++i) {
    const FrontPoint& point = crack.points[i];
    const FrontOpening& o = openings[i];
    const bool ligament = opens_beyond_elasticity(o.intensity, r, m);
    const Vec3& K = ligament ? o.intensity : resolved[i].intensity;  // what breaks anyway is not smoothed
    FrontDecision d;
    d.drive = growth.law->drive(K);
    d.toughness = growth.toughness(crack.sheet.mesh.positions[point.node]).value;
    const bool stays = crack.sheet.state[point.node] == FrontState::arrested ||
                       (resolved[i].pressed && !settings.published_compression);
    d.length = stays ? 0 : resolved[i].step * growth.law->length(d.drive, d.toughness, r);
    d.angle = ligament ? 0 : resolved[i].turn * growth.law->direction(K);
    report.largest_intensity = std::max(report.largest_intensity, d.drive);
    // Where the toughness varies every marker decides for itself.
    if (d.length > 0 || (!stays && d.drive > 0 && !body->toughness.homogeneous()))
      steps.push_back({point.node, point.frame, d.angle, d.drive, resolved[i].limit(r),
                       ligament ? 0 : further_turn(path, point, d)});
    if (!o.in_range && !warned) {
      warned = true;
      report.warnings.push_back(
          fmt::format("frame {}: the {} is asked beyond its training data (K_I = {:.3g}, K_II = {:.3g}, "
                      "K_III = {:.3g} Pa√m); train it on "
                      "a database that covers such loads",
                      report.frame, report.source, o.intensity[0], o.intensity[1], o.intensity[2]));
    }
    decisions.push_back(d);
  }
  for (const FrontPoint& point : ligament_points(crack))
    steps.push_back(
        {point.node, point.frame, 0,
         std::max(report.largest_intensity,
                  kLigamentIntensity * growth.toughness(crack.sheet.mesh.positions[point.node]).value)});
  return steps;
}

std::vector<FrontStep> Fracture::State::open(StepReport& report, Stopwatch& clock) {
  report.front_points = crack.points.size();
  compute_openings(report);
  report.opening_seconds = clock.lap();
  frame = report.frame;
  return decide(report);
}

void Fracture::State::grow(const std::vector<FrontStep>& steps, StepReport& report, Stopwatch& clock) {
  if (ligament_breaks(false)) {
    stop = StopReason::separated;
    return;
  }
  const std::size_t fronts_before = crack.sheet.fronts.size();
  if (may_start_cracks()) start_cracks(report);
  const bool new_crack = crack.sheet.fronts.size() > fronts_before;
  const std::size_t before = sheets.driving().triangle_count() + crack.sheet.mesh.triangle_count();
  if (!steps.empty()) sheets.advance(with_drawn_nodes(crack.sheet, steps), growth);
  if (!steps.empty() || new_crack)
    update_crack(crack, body->surface, body->crack_edge,
                 solves_next() ? NearCracks::divided : NearCracks::as_it_is);
  report.fracture_seconds = clock.lap();
  report.crack_triangles = crack.trimmed.triangle_count();
  const bool grown = sheets.driving().triangle_count() + crack.sheet.mesh.triangle_count() > before;
  if (!grown && !new_crack)
    stop = ligament_breaks(true) ? StopReason::separated : StopReason::arrested;
  else if (separated())
    stop = StopReason::separated;
}

// A later frame that cannot be computed ends the run, which keeps the frames before.
void Fracture::State::attempt(StepReport& report, const std::function<void()>& part) {
  try {
    part();
  } catch (const ComputationError& error) {
    if (first(report.frame)) throw;
    report.warnings.push_back(fmt::format("frame {}: {}; the run ends here and keeps the frames before",
                                          report.frame, error.what()));
    stop = StopReason::singular;
  }
}

// What observers throw, a full disk, is no part of the frame.
void Fracture::State::compute_frame(const Fracture& self, StepReport& report) {
  Stopwatch clock;
  std::vector<FrontStep> steps;
  attempt(report, [&] { steps = open(report, clock); });
  if (stop) return;
  for (FractureObserver* observer : observers)
    observer->on_opening(self);
  history.remember(crack, openings);
  report.other_seconds = clock.lap();
  attempt(report, [&] { grow(steps, report, clock); });
}

Fracture::Fracture(std::shared_ptr<const PreparedBody> body, LoadCase load, const RunSpec& settings,
                   const MakeOpeningSource& source, std::shared_ptr<const GrowthLaw> law)
    : state_(std::make_unique<State>(std::move(body), std::move(load), settings, source, std::move(law))) {}
Fracture::~Fracture() = default;
Fracture::Fracture(Fracture&&) noexcept = default;
Fracture& Fracture::operator=(Fracture&&) noexcept = default;

StepReport Fracture::step() {
  State& s = *state_;
  StepReport report;
  const bool starts = !s.started;
  if (starts) s.start(report);
  if (s.stop) {
    report.frame = s.frame;
    report.stop = s.stop;
    if (starts)
      for (FractureObserver* observer : s.observers)
        observer->on_step(*this, report);
    return report;
  }
  report.frame = s.frame + 1;
  for (FractureObserver* observer : s.observers)
    observer->on_frame(*this, report.frame);
  s.compute_frame(*this, report);
  report.stop = s.stop;
  report.moving = !s.stop;
  for (FractureObserver* observer : s.observers)
    observer->on_step(*this, report);
  return report;
}

void Fracture::set_load(LoadCase load) {
  State& s = *state_;
  s.bem.set_load(std::move(load));
  if (s.stop != StopReason::arrested && s.stop != StopReason::intact) return;
  if (s.stop == StopReason::intact) s.started = false;  // a crack is looked for again
  s.stop.reset();
}

void Fracture::count_from(int frames) {
  state_->before = state_->frame = frames;
}

void Fracture::add_observer(FractureObserver& observer) {
  state_->observers.push_back(&observer);
}

void Fracture::keep_rows(RowStore* store) {
  state_->bem.keep_rows(store);
}

const PreparedBody& Fracture::body() const {
  return *state_->body;
}
std::shared_ptr<const PreparedBody> Fracture::shared_body() const {
  return state_->body;
}
const RunSpec& Fracture::settings() const {
  return state_->settings;
}
const LoadCase& Fracture::load() const {
  return state_->bem.body().load();
}
std::size_t Fracture::loads() const {
  return state_->bem.loads();
}
int Fracture::frame() const {
  return state_->frame;
}
std::optional<StopReason> Fracture::stop() const {
  return state_->stop;
}
const CrackState& Fracture::crack() const {
  return state_->crack;
}
const std::vector<FrontOpening>& Fracture::openings() const {
  return state_->openings;
}
const std::vector<FrontDecision>& Fracture::decisions() const {
  return state_->decisions;
}
bool Fracture::solved() const {
  return state_->solved();
}
const std::vector<FrontOpening>* Fracture::truth() const {
  if (state_->predictor) return state_->predictor->truth();
  return state_->solved() ? &state_->openings : nullptr;
}
const CrackedBody& Fracture::solution() const {
  return state_->bem.body();
}
const FrontHistory& Fracture::history() const {
  return state_->history;
}
double Fracture::rayleigh_speed() const {
  return state_->rayleigh_speed;
}
std::size_t Fracture::new_cracks() const {
  return static_cast<std::size_t>(state_->new_cracks);
}
std::size_t Fracture::cracks() const {
  return state_->body->cracks.size() + new_cracks();
}

const std::vector<TriMesh>& Fracture::visible_sheets() const {
  return state_->sheets.visible();
}
TriMesh Fracture::swept_surface() const {
  return state_->sheets.swept();
}
void Fracture::cut_below(double volume) {
  state_->parting.cut_below(volume);
}

double Fracture::volume_off() const {
  return state_->parting.volume_off();
}
const BodyCut* Fracture::parted() const {
  return state_->parting.cut();
}

StopReason run_frames(Fracture& fracture, int limit, const std::function<void()>& progress) {
  for (;;) {
    if (interrupted()) return StopReason::interrupted;
    const StepReport step = fracture.step();
    if (progress) progress();
    if (step.stop) return *step.stop;
    if (fracture.frame() >= limit) return StopReason::frame_limit;
  }
}

}  // namespace conchoid
