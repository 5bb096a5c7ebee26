#include "conchoid/sim/make_runs.hpp"

#include <atomic>
#include <map>
#include <optional>

#include "conchoid/core/error.hpp"
#include "conchoid/core/interrupt.hpp"
#include "conchoid/core/parallel.hpp"
#include "conchoid/core/stopwatch.hpp"
#include "conchoid/sim/breakup.hpp"
#include "conchoid/sim/led_opening.hpp"
#include "conchoid/sim/methods.hpp"
#include "conchoid/sim/recorders.hpp"

namespace conchoid {
namespace {

PreparedRun under_drawn_load(const DatabaseSpec& spec, std::shared_ptr<const PreparedBody> body,
                             std::int32_t run) {
  const DrawnLoad load = draw_load(spec, run);
  PreparedRun out{loaded_scene(spec, load), std::move(body), {}};
  RunRecord& record = out.record;
  record.id = run;
  record.body_class = body_class(spec.scene.body);
  record.seed = load.seed;
  record.direction = load.direction;
  record.magnitude = load.magnitude;
  record.alpha = load.slope;
  record.beta = load.rotation;
  return out;
}

RunRecord world_record(const DatabaseSpec& spec, std::int32_t run) {
  RunRecord record;
  record.id = run;
  record.body = run / spec.world->runs_per_body;
  record.body_class = spec.world->classes[static_cast<std::size_t>(record.body) % spec.world->classes.size()];
  return record;
}

PreparedRun under_world_load(const DatabaseSpec& spec, const WorldBody& drawn,
                             std::shared_ptr<const PreparedBody> body, std::int32_t run) {
  const WorldLoad load = draw_world_load(drawn, *body, spec.seed, run);
  PreparedRun out{loaded_scene(drawn, load), std::move(body), world_record(spec, run)};
  out.scene.run.frames = spec.scene.run.frames;
  RunRecord& record = out.record;
  record.seed = load.seed;
  record.direction = load.direction;
  record.magnitude = load.magnitude;
  record.alpha = load.slope;
  record.load = load.kind;
  return out;
}

void exclude(RunRecord& record, const std::exception& error) {
  record.stop = "failed";
  record.reason = error.what();
  record.excluded = true;
}

BreakupSettings breakup_settings(const DatabaseSpec& spec, const Scene& scene) {
  BreakupSettings settings{BreakupSettings::After::chips};
  if (!spec.led_by) return settings;
  settings.source = [leaders = sources_by(opening_method(spec.led_by->name()), scene.run, spec.led_by.get())](
                        const PreparedBody& body) -> MakeOpeningSource {
    return
        [leader = leaders(body)](BemOpening& bem) { return std::make_unique<LedOpening>(bem, leader(bem)); };
  };
  return settings;
}

RunPart computed(const DatabaseSpec& spec, PreparedRun run) {
  const Stopwatch clock;
  RunPart out{std::move(run.record), {}};
  RunRecord& record = out.record;
  try {
    Breakup breakup(run.scene, run.body, breakup_settings(spec, run.scene));
    GrowthRecorder growth;
    SampleRecorder samples(SampleRecorder::Fields::all);
    breakup.add_observer(growth);
    breakup.add_observer(samples);
    const StopReason stop = breakup.run(run.scene.run.frames);
    if (stop == StopReason::interrupted) throw Interrupted("interrupted");
    record.frames = breakup.frame();
    record.stop = name(stop);
    record.reason = exclusion_reason(
        {record.alpha, record.frames, stop != StopReason::frame_limit,
         static_cast<std::int32_t>(breakup.cracks()), growth.largest(), run.body->crack_edge},
        spec.exclusion);
    record.excluded = !record.reason.empty();
    out.samples = samples.take();
    for (std::int32_t& id : out.samples.run())
      id = record.id;
  } catch (const ComputationError& error) {
    exclude(record, error);
  }
  record.wall_seconds = clock.seconds();
  return out;
}

// Runs of one body of a world.
class WorldRuns {
 public:
  WorldRuns(const DatabaseSpec& spec, int body) : spec_(spec) {
    try {
      drawn_ = draw_world_body(*spec.world, spec.seed, body);
      prepared_ = prepare(*drawn_);
    } catch (const ComputationError& error) {
      failure_ = error;
    } catch (const InputError& error) {  // what was drawn does not fit together: no one else's mistake
      failure_ = ComputationError(error.what());
    }
  }
  /// Throws ComputationError where body or load could not be made.
  PreparedRun prepared(std::int32_t run) const {
    if (failure_) throw *failure_;
    return under_world_load(spec_, *drawn_, prepared_, run);
  }
  RunPart make(std::int32_t run) const {
    RunPart failed{world_record(spec_, run), {}};
    try {
      return computed(spec_, prepared(run));
    } catch (const ComputationError& error) {
      exclude(failed.record, error);
    } catch (const InputError& error) {
      exclude(failed.record, error);
    }
    return failed;
  }

 private:
  const DatabaseSpec& spec_;
  std::optional<WorldBody> drawn_;
  std::shared_ptr<const PreparedBody> prepared_;
  std::optional<ComputationError> failure_;
};

/// Tasks begun in their order, whichever thread takes them: a database that is closed early holds the first runs, not
/// some of each thread's share.
void parallel_in_order(std::size_t n, const std::function<void(std::size_t)>& task) {
  std::atomic<std::size_t> next{0};
  parallel_for(n, 1, [&](std::size_t, std::size_t) { task(next++); });
}

}  // namespace

PreparedRun prepare_run(const DatabaseSpec& spec, const std::shared_ptr<const PreparedBody>& body,
                        std::int32_t run) {
  if (!spec.world) return under_drawn_load(spec, body, run);
  return WorldRuns(spec, run / spec.world->runs_per_body).prepared(run);
}

PreparedRun prepare_run(const DatabaseSpec& spec, std::int32_t run) {
  return prepare_run(spec, spec.world ? nullptr : std::make_shared<const PreparedBody>(prepare(spec.scene)),
                     run);
}

void make_runs(const DatabaseSpec& spec, std::span<const std::int32_t> runs,
               const std::function<void(RunPart)>& keep) {
  if (runs.empty()) return;
  if (!spec.world) {
    const auto body = std::make_shared<const PreparedBody>(prepare(spec.scene));
    parallel_in_order(runs.size(),
                      [&](std::size_t i) { keep(computed(spec, under_drawn_load(spec, body, runs[i]))); });
    return;
  }
  std::map<std::int32_t, std::vector<std::int32_t>> of_body;
  for (const std::int32_t run : runs)
    of_body[run / spec.world->runs_per_body].push_back(run);
  const std::vector<std::pair<std::int32_t, std::vector<std::int32_t>>> bodies(of_body.begin(),
                                                                               of_body.end());
  parallel_in_order(bodies.size(), [&](std::size_t b) {
    const WorldRuns of_this(spec, bodies[b].first);
    for (const std::int32_t run : bodies[b].second) {
      throw_if_interrupted();
      keep(of_this.make(run));
    }
  });
}

}  // namespace conchoid
