#include "conchoid/sim/breakup.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <deque>
#include <optional>

#include "conchoid/bem/row_store.hpp"
#include "conchoid/core/error.hpp"
#include "conchoid/core/interrupt.hpp"
#include "conchoid/core/parallel.hpp"
#include "conchoid/sim/broken_pieces.hpp"
#include "conchoid/sim/crack_sites.hpp"
#include "conchoid/sim/cut_piece.hpp"
#include "conchoid/sim/mended_fragment.hpp"
#include "conchoid/sim/waiting_piece.hpp"
#include "conchoid/surface/separation.hpp"

namespace conchoid {
namespace {

constexpr double kSmallestVolume = 8;        // × r̄³: two edges of the cracks each way
constexpr std::size_t kReadySideBySide = 2;  // pieces; more would be in vain where a run ends before they are

// Whether a crack starts or grows in a frame whose openings are known.
bool moves(const Fracture& fracture) {
  const bool homogeneous = fracture.body().toughness.homogeneous();
  for (const FrontDecision& d : fracture.decisions())
    if (d.length > 0 || (!homogeneous && d.drive > 0)) return true;
  if (!ligament_points(fracture.crack()).empty()) return true;
  const auto allowed = static_cast<std::size_t>(fracture.settings().max_cracks);
  return fracture.new_cracks() > 0 ||
         (fracture.solved() && fracture.new_cracks() < allowed &&
          !find_crack_sites(fracture.body(), fracture.crack(), fracture.solution(), 1).empty());
}

// Hands on what a body does; of a piece nothing before the first frame in which it moves.
class Relay : public FractureObserver {
 public:
  void add(FractureObserver& observer) { to_.push_back(&observer); }
  void begin(bool piece) { quiet_ = piece; }
  bool quiet() const { return quiet_; }

  void on_frame(const Fracture& fracture, int frame) override {
    for (FractureObserver* observer : to_)
      observer->on_frame(fracture, frame);
  }
  void on_opening(const Fracture& fracture) override {
    quiet_ = quiet_ && !moves(fracture);
    if (quiet_) return;
    for (FractureObserver* observer : to_)
      observer->on_opening(fracture);
  }
  void on_step(const Fracture& fracture, const StepReport& step) override {
    if (quiet_) return;
    for (FractureObserver* observer : to_)
      observer->on_step(fracture, step);
  }

 private:
  std::vector<FractureObserver*> to_;
  bool quiet_ = false;
};

// Rows under the names of their bodies: those of the first as they are.
class NamedRows : public RowStore {
 public:
  RowStore* store = nullptr;
  std::size_t body = 0;

  std::optional<std::vector<EnrichmentRows>> recall(const std::string& name) override {
    return store->recall(of_body(name));
  }
  void keep(const std::string& name, const std::vector<EnrichmentRows>& rows) override {
    store->keep(of_body(name), rows);
  }

 private:
  std::string of_body(const std::string& name) const {
    return body == 0 ? name : fmt::format("{} of body {}", name, body);
  }
};

}  // namespace

struct Breakup::State {
  BreakupSettings settings;
  RunSpec run;
  OutputSpec output;
  double volume;  // of the first body

  // the body that breaks
  std::shared_ptr<const PreparedBody> body;
  std::shared_ptr<const Scene> scene;
  std::unique_ptr<Fracture> fracture;
  std::optional<std::size_t> id;  // of the piece; none: the first body
  bool ended = false;

  std::size_t old_cracks, new_cracks = 0;  // of bodies that have ended
  int frame = 0;
  std::size_t triangles = 0, bodies = 1;
  Relay relay;
  NamedRows rows;
  std::optional<BrokenPieces> pieces;
  std::deque<WaitingPiece> waiting;
  std::optional<WaitingPiece> at_work;  // the piece that breaks
  std::vector<std::string> warnings;
  StopReason outcome = StopReason::frame_limit;  // if nothing goes on
  std::optional<StopReason> stop;

  State(const Scene& of_body, std::shared_ptr<const PreparedBody> prepared, BreakupSettings how)
      : settings(std::move(how)),
        run(of_body.run),
        output(of_body.output),
        volume(prepared->infinite() ? 0 : enclosed_volume(prepared->detailed)),
        old_cracks(prepared->cracks.size()) {
    begin(std::make_shared<const Scene>(of_body), std::move(prepared));
  }

  std::size_t cracks_left() const {
    const auto allowed = static_cast<std::size_t>(run.max_cracks);
    return allowed - std::min(allowed, new_cracks);
  }
  bool few_enough() const {
    return run.max_fragments == 0 || pieces->count() < static_cast<std::size_t>(run.max_fragments);
  }
  bool grown() const {
    std::size_t at_first = 0;
    for (const TriMesh& crack : body->cracks)
      at_first += crack.triangle_count();
    return fracture->crack().sheet.mesh.triangle_count() > at_first;
  }

  void begin(std::shared_ptr<const Scene> of_body, std::shared_ptr<const PreparedBody> prepared);
  bool begin_next();
  bool begin_piece(WaitingPiece& piece);
  bool may_begin(const WaitingPiece& piece) const;
  void make_ready();
  bool may_break(const Fragment& piece) const;
  void wait(const std::vector<Fragment>& cut, std::size_t first_id, std::size_t most);
  void end_body(StopReason reason);
  void end_without_chips(StopReason reason);
  void end_first(StopReason reason);
  void end_piece();
  void step_piece(StepReport& report);
  void give_up(const std::exception& error);
  bool leave_out_a_crack();
};

void Breakup::State::begin(std::shared_ptr<const Scene> of_body,
                           std::shared_ptr<const PreparedBody> prepared) {
  scene = std::move(of_body);
  body = std::move(prepared);
  fracture = std::make_unique<Fracture>(body, load_of(*scene, *body), scene->run,
                                        settings.source ? settings.source(*body) : MakeOpeningSource{});
  ended = false;
  fracture->count_from(frame);
  if (settings.after == BreakupSettings::After::chips) fracture->cut_below(run.smallest_body * volume);
  fracture->add_observer(relay);
  if (rows.store) fracture->keep_rows(&rows);
  relay.begin(id.has_value());
}

// Largest first. Of the first body's volume, whatever body it was cut from.
bool Breakup::State::may_break(const Fragment& piece) const {
  const double r = body->crack_edge;
  return piece.volume >= std::max(run.smallest_body * volume, kSmallestVolume * r * r * r) &&
         (cracks_left() > 0 || !piece.unfinished.sheets.empty());
}

void Breakup::State::wait(const std::vector<Fragment>& cut, std::size_t first_id, std::size_t most) {
  for (std::size_t i = 0; i < std::min(most, cut.size()); ++i)
    if (may_break(cut[i])) waiting.emplace_back(first_id + i, cut[i], body, scene);
}

bool Breakup::State::may_begin(const WaitingPiece& piece) const {
  return (!pieces || few_enough()) && (cracks_left() > 0 || !piece.fragment.unfinished.sheets.empty());
}

// The first that wait, side by side: most of that works on one thread.
void Breakup::State::make_ready() {
  std::vector<WaitingPiece*> next;
  for (WaitingPiece& piece : waiting)
    if (next.size() < kReadySideBySide && !piece.ready() && may_begin(piece)) next.push_back(&piece);
  parallel_for(next.size(), 1, [&](std::size_t i, std::size_t) { next[i]->make_ready(); });
}

bool Breakup::State::begin_piece(WaitingPiece& piece) {
  PieceScene own = piece.take();
  if (!is_loaded(own.scene)) return false;
  RunSpec& its_run = own.scene.run;
  its_run.max_cracks = static_cast<int>(cracks_left());
  its_run.smallest_fragment = std::min(0.5, run.smallest_fragment * volume / piece.fragment.volume);
  if (pieces && run.max_fragments > 0)
    its_run.max_fragments = run.max_fragments - static_cast<int>(pieces->count()) + 1;
  auto prepared = std::make_shared<const PreparedBody>(prepare(own.scene, std::move(own.body)));
  id = piece.id;
  at_work = std::move(piece);
  rows.body = bodies++;
  begin(std::make_shared<const Scene>(std::move(own.scene)), std::move(prepared));
  return true;
}

// The next piece that can break; false if there is none.
bool Breakup::State::begin_next() {
  while (!waiting.empty()) {
    const bool may = may_begin(waiting.front());
    if (may && !waiting.front().ready()) make_ready();
    WaitingPiece next = std::move(waiting.front());
    waiting.pop_front();
    try {
      if (may && begin_piece(next)) return true;
    } catch (const InputError& error) {
      give_up(error);
    } catch (const ComputationError& error) {
      give_up(error);
    }
  }
  return false;
}

void Breakup::State::give_up(const std::exception& error) {
  warnings.push_back(fmt::format("after frame {}: a piece is left as it is, as it cannot be computed: {}",
                                 frame, error.what()));
}

// Cracks that touch each other in a piece can make its system singular: it is tried again without the smallest.
bool Breakup::State::leave_out_a_crack() {
  std::vector<TriMesh>& cracks = at_work->fragment.unfinished.sheets;
  if (cracks.size() < 2) return false;
  const auto smaller = [](const TriMesh& a, const TriMesh& b) { return surface_area(a) < surface_area(b); };
  cracks.erase(std::min_element(cracks.begin(), cracks.end(), smaller));
  warnings.push_back(fmt::format(
      "after frame {}: a crack that ends in a piece stays as it is, as the piece cannot be computed with it",
      frame));
  waiting.push_front(*std::move(at_work));
  at_work.reset();
  return true;
}

// A chip is no separation; what it came off goes on, if it can.
void Breakup::State::end_without_chips(StopReason reason) {
  const bool chip = reason == StopReason::separated && fracture->volume_off() < run.smallest_body * volume;
  outcome = chip || (id && reason == StopReason::intact) ? StopReason::arrested : reason;
  if (chip) wait(cut_into_pieces(*fracture, output).fragments, 0, 1);
}

void Breakup::State::end_first(StopReason reason) {
  outcome = reason;
  if (body->infinite() || reason == StopReason::interrupted) return;  // then there is no time to cut it
  Pieces cut;
  try {
    cut = cut_into_pieces(*fracture, output);
  } catch (const ComputationError& error) {
    warnings.push_back(
        fmt::format("the body cannot be cut into pieces: {}; crack.ply holds the crack. Another "
                    "resolution.surface may help",
                    error.what()));
    return;
  }
  const std::size_t count = cut.fragments.size();
  const bool goes_on = run.after_separation == AfterSeparation::go_on;
  if (reason == StopReason::separated && count == 1) {
    outcome = StopReason::arrested;
    cut.warnings.push_back(fmt::format(
        "the boundary elements see the body come apart, but it is left in one piece: what has come off is "
        "below run.smallest_fragment = {:g} of its volume, or run.max_fragments = {} joins it",
        run.smallest_fragment, run.max_fragments));
  }
  // The coarse crack may end a triangle short of where the fine one has cut through.
  if (count > 1 && (reason == StopReason::arrested || (goes_on && reason == StopReason::singular)))
    outcome = StopReason::separated;
  const std::vector<Fragment> raw = goes_on && count > 1 ? cut.fragments : std::vector<Fragment>{};
  pieces.emplace(body, std::move(cut), output);
  if (may_go_on(reason)) return;
  wait(raw, 0, raw.size());
}

void Breakup::State::end_piece() {
  if (interrupted() || !(grown() || fracture->parted()))
    return;  // a last ligament may break before anything grows
  std::optional<SolidParts> cut = cut_piece(*fracture, output);
  if (!cut) {
    warnings.push_back(
        fmt::format("after frame {}: what broke further in a piece could not be cut out of it cleanly; the "
                    "piece is left as it was before, and its cracks are seen in the frames only",
                    fracture->frame()));
    return;
  }
  if (cut->most_mended > kMendedVolume)
    warnings.push_back(
        fmt::format("after frame {}: a part of a piece that broke further folds over itself; it is mended "
                    "there, at the cost of up to {:g} of its volume",
                    fracture->frame(), cut->most_mended));
  const std::vector<Fragment> raw = cut->parts.fragments;
  const std::size_t first = pieces->replace(*id, std::move(cut->parts));
  if (raw.size() > 1) wait(raw, first, raw.size());
}

void Breakup::State::end_body(StopReason reason) {
  ended = true;
  new_cracks += fracture->new_cracks();
  if (!relay.quiet()) triangles = body->surface.triangle_count() + fracture->crack().trimmed.triangle_count();
  if (settings.after == BreakupSettings::After::stop)
    outcome = reason;
  else if (settings.after == BreakupSettings::After::chips)
    end_without_chips(reason);
  else if (!id)
    end_first(reason);
  else
    end_piece();
}

// What goes wrong in a piece ends that piece, not the run.
void Breakup::State::step_piece(StepReport& report) {
  try {
    report = fracture->step();
  } catch (const SingularSystem& error) {
    if (!leave_out_a_crack()) give_up(error);
    report.stop = StopReason::singular;
  } catch (const ComputationError& error) {
    give_up(error);
    report.stop = StopReason::singular;
  }
}

Breakup::Breakup(const Scene& scene, std::shared_ptr<const PreparedBody> body, BreakupSettings settings)
    : state_(std::make_unique<State>(scene, std::move(body), std::move(settings))) {}
Breakup::~Breakup() = default;
Breakup::Breakup(Breakup&&) noexcept = default;
Breakup& Breakup::operator=(Breakup&&) noexcept = default;

void Breakup::add_observer(FractureObserver& observer) {
  state_->relay.add(observer);
}

void Breakup::keep_rows(RowStore* store) {
  state_->rows.store = store;
  state_->fracture->keep_rows(store ? &state_->rows : nullptr);
}

StepReport Breakup::step() {
  State& s = *state_;
  StepReport report;
  report.frame = s.frame;
  while (!s.stop) {
    if (s.ended && !s.begin_next()) {
      s.stop = s.outcome;
      break;
    }
    StepReport done;
    if (s.id)
      s.step_piece(done);
    else
      done = s.fracture->step();
    const bool counts = !s.relay.quiet();
    if (counts) {
      report = done;
      s.frame = s.fracture->frame();
    }
    if (done.stop) s.end_body(*done.stop);
    if (s.ended && s.waiting.empty()) s.stop = s.outcome;
    if (counts) break;
  }
  report.stop = s.stop;
  report.moving = !s.stop;
  return report;
}

StopReason Breakup::run(int limit, const std::function<void()>& progress) {
  State& s = *state_;
  const auto end = [&](StopReason reason) {
    s.stop = reason;
    s.waiting.clear();
    try {
      if (!s.ended) s.end_body(reason);
    } catch (const Interrupted&) {  // there is no time to cut it
      s.stop = StopReason::interrupted;
    }
    s.waiting.clear();
    return *s.stop;
  };
  for (;;) {
    if (s.stop) return *s.stop;
    if (interrupted()) return end(StopReason::interrupted);
    StepReport report;
    try {
      report = step();
    } catch (const Interrupted&) {  // in the middle of a frame: the ones before stay
      return end(StopReason::interrupted);
    }
    if (progress) progress();
    if (report.stop) return *report.stop;
    if (s.frame >= limit) return end(StopReason::frame_limit);
  }
}

int Breakup::frame() const {
  return state_->frame;
}

std::size_t Breakup::cracks() const {
  const State& s = *state_;
  return s.old_cracks + s.new_cracks + (s.ended ? 0 : s.fracture->new_cracks());
}

const Fracture& Breakup::fracture() const {
  return *state_->fracture;
}

std::size_t Breakup::triangles() const {
  return state_->triangles;
}

Pieces Breakup::take_pieces() {
  State& s = *state_;
  Pieces out = s.pieces ? s.pieces->take() : Pieces{};
  if (!s.pieces) {
    const bool cut_short = s.stop == StopReason::interrupted;
    out.crack = cut_short ? swept_crack(*s.fracture) : crack_surface(*s.fracture);
    if (cut_short && !s.body->infinite())
      out.warnings.push_back(
          "stopped before the body was cut: there are no pieces, and crack.ply holds the surface "
          "as swept; conchoid run --resume goes on from here");
  }
  out.warnings.insert(out.warnings.end(), s.warnings.begin(), s.warnings.end());
  return out;
}

}  // namespace conchoid
