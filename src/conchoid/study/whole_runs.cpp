#include "conchoid/study/whole_runs.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>

#include "conchoid/core/error.hpp"
#include "conchoid/core/interrupt.hpp"
#include "conchoid/core/parallel.hpp"
#include "conchoid/core/progress.hpp"
#include "conchoid/learn/summary.hpp"
#include "conchoid/sim/breakup.hpp"
#include "conchoid/sim/make_runs.hpp"
#include "conchoid/sim/methods.hpp"
#include "conchoid/study/small_changes.hpp"
#include "conchoid/study/surface_distance.hpp"

namespace conchoid {
namespace {

struct Outcome {
  StopReason stop = StopReason::intact;
  int frames = 0;
  double opening_seconds = 0;
  TriMesh crack;
};

class OpeningClock : public FractureObserver {
 public:
  void on_step(const Fracture&, const StepReport& step) override { seconds_ += step.opening_seconds; }
  double seconds() const { return seconds_; }

 private:
  double seconds_ = 0;
};

Outcome outcome_of(const PreparedRun& run, const RunMethod& how, int frames) {
  const OpeningMethod& method = checked_method(how.method, how.regressor, how.tolerance);
  BreakupSettings settings{BreakupSettings::After::stop};
  settings.source = sources_by(method, run.scene.run, how.regressor, 0, how.tolerance);
  Breakup breakup(run.scene, run.body, settings);
  OpeningClock clock;
  breakup.add_observer(clock);
  Outcome out;
  out.stop = breakup.run(frames);
  if (out.stop == StopReason::interrupted) throw Interrupted("interrupted");
  out.frames = breakup.frame();
  out.opening_seconds = clock.seconds();
  out.crack = breakup.take_pieces().crack;
  return out;
}

Outcome solved_outcome(const DatabaseSpec& spec, const PreparedRun& run) {
  return outcome_of(run, {"BEM", "bem", nullptr}, spec.exclusion.frame_limit);
}

/// How many frames a method has for what takes so many solved ones.
int frames_beside(int solved) {
  return 2 * solved + 4;
}

double apart(const TriMesh& a, const TriMesh& b, double diagonal) {
  const double mean = symmetric_distance(a, b).mean / diagonal;
  return std::isfinite(mean) ? mean : 1;
}

// None where boundary elements say nothing.
std::vector<WholeRun> compared(const DatabaseSpec& spec, const std::shared_ptr<const PreparedBody>& body,
                               std::int32_t number, const std::vector<RunMethod>& methods,
                               const WholeRunSettings& settings) {
  std::vector<WholeRun> rows;
  try {
    const PreparedRun run = with_load(prepare_run(spec, body, number), settings.load);
    const RunMethod bem{"BEM", "bem", nullptr};
    const Outcome solved = solved_outcome(spec, run);
    if (solved.frames < settings.least_frames || solved.stop == StopReason::frame_limit) return {};
    const double diagonal = bounding_box(run.body->surface).diagonal();
    const auto compare = [&](const std::string& title, const PreparedRun& made_of, const RunMethod& method) {
      throw_if_interrupted();
      const Outcome made = outcome_of(made_of, method, frames_beside(solved.frames));
      const double distance = apart(solved.crack, made.crack, diagonal);
      rows.push_back({number, run.record.body_class, title, made.stop, solved.stop, made.frames,
                      solved.frames, distance, distance * diagonal / bounding_box(solved.crack).diagonal(),
                      made.opening_seconds, solved.opening_seconds});
    };
    for (const RunMethod& method : methods)
      compare(method.title, run, method);
    for (const SmallChange& small : small_changes())
      if (const auto changed = settings.noise_floor ? small.change(run) : std::nullopt)
        compare(small.title, *changed, bem);
  } catch (const ComputationError&) {  // neither is a fault of a method: the run cannot be made
    rows.clear();
  } catch (const InputError&) {
    if (!spec.world) throw;
    rows.clear();
  }
  return rows;
}

/// None in a world, where each run has its own.
std::shared_ptr<const PreparedBody> shared_body(const DatabaseSpec& spec) {
  return spec.world ? nullptr : std::make_shared<const PreparedBody>(prepare(spec.scene));
}

double quantile(std::vector<double> values, double level) {
  std::sort(values.begin(), values.end());
  return values[static_cast<std::size_t>(std::ceil(level * static_cast<double>(values.size() - 1)))];
}

}  // namespace

WholeRuns whole_runs(const DatabaseSpec& spec, std::span<const std::int32_t> runs,
                     const std::vector<RunMethod>& methods, const WholeRunSettings& settings) {
  const auto body = shared_body(spec);
  std::vector<std::vector<WholeRun>> of_run(runs.size());
  Progress progress("runs", runs.size());
  parallel_for(runs.size(), 1, [&](std::size_t i, std::size_t) {
    throw_if_interrupted();
    of_run[i] = compared(spec, body, runs[i], methods, settings);
    progress.advance();
  });
  WholeRuns out;
  for (const auto& rows : of_run) {
    out.rows.insert(out.rows.end(), rows.begin(), rows.end());
    out.left_out += rows.empty() ? 1 : 0;
  }
  return out;
}

std::vector<CrackSurfaces> crack_surfaces(const DatabaseSpec& spec, std::span<const WholeRun> rows,
                                          const RunMethod& method, const WholeRunSettings& settings) {
  const auto body = shared_body(spec);
  std::vector<CrackSurfaces> out(rows.size());
  parallel_for(rows.size(), 1, [&](std::size_t i, std::size_t) {
    throw_if_interrupted();
    const PreparedRun run = with_load(prepare_run(spec, body, rows[i].run), settings.load);
    out[i] = {run.body->surface, solved_outcome(spec, run).crack,
              outcome_of(run, method, frames_beside(rows[i].solved_frames)).crack};
  });
  return out;
}

std::vector<WholeRun> farthest_off(const WholeRuns& runs, const std::string& title, std::size_t count) {
  std::vector<WholeRun> rows;
  std::copy_if(runs.rows.begin(), runs.rows.end(), std::back_inserter(rows),
               [&](const WholeRun& row) { return row.title == title; });
  std::stable_sort(rows.begin(), rows.end(),
                   [](const WholeRun& a, const WholeRun& b) { return a.surface > b.surface; });
  rows.resize(std::min(rows.size(), count));
  return rows;
}

std::map<std::pair<std::string, std::string>, WholeRunScore> scores(const WholeRuns& runs) {
  std::map<std::pair<std::string, std::string>, std::vector<const WholeRun*>> groups;
  for (const WholeRun& row : runs.rows)
    for (const std::string& of : {row.body_class, std::string()})
      groups[{of, row.title}].push_back(&row);
  std::map<std::pair<std::string, std::string>, WholeRunScore> out;
  for (const auto& [key, rows] : groups) {
    std::vector<double> surface, ratio;
    double seconds = 0, solved_seconds = 0;
    WholeRunScore& score = out[key];
    for (const WholeRun* row : rows) {
      surface.push_back(row->surface);
      ratio.push_back(static_cast<double>(row->frames) / row->solved_frames);
      seconds += row->seconds;
      solved_seconds += row->solved_seconds;
      score.lost += row->stop == StopReason::frame_limit ? 1 : 0;
    }
    score.runs = static_cast<int>(rows.size());
    score.median = statistics(surface).median;
    score.p95 = quantile(surface, 0.95);
    score.largest = statistics(surface).maximum;
    score.opening_ratio = seconds / solved_seconds;
    score.frames_ratio = statistics(ratio).median;
  }
  return out;
}

}  // namespace conchoid
