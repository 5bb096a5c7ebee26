#include "conchoid/sim/generate.hpp"

#include <tbb/parallel_for_each.h>

#include <chrono>

#include "conchoid/core/error.hpp"
#include "conchoid/core/interrupt.hpp"
#include "conchoid/core/parallel.hpp"
#include "conchoid/core/progress.hpp"
#include "conchoid/sim/breakup.hpp"
#include "conchoid/sim/recorders.hpp"

namespace conchoid {
namespace {

DatabaseHeader make_header(const DatabaseSpec& spec, const GenerateOptions& options) {
  const MaterialSpec& m = spec.scene.material;
  DatabaseHeader header;
  header.models = {spec.scene.body.model.empty() ? spec.scene.body.mesh.filename().string()
                                                 : spec.scene.body.model};
  header.material = {m.youngs_modulus, m.poisson_ratio, m.density,
                     m.strength,       m.toughness,     m.compressive_factor};
  header.resolution = spec.scene.resolution.crack.value_or(0);
  header.spec = spec.scene.text;
  header.seed = spec.seed;
  header.planned_runs = spec.runs;
  header.shard = options.shard;
  header.shards = options.shards;
  return header;
}

}  // namespace

GeneratedRun generate_run(const DatabaseSpec& spec, const std::shared_ptr<const PreparedBody>& body,
                          int run) {
  const auto start = std::chrono::steady_clock::now();
  const DrawnLoad load = draw_load(spec, run);
  GeneratedRun out;
  RunRecord& record = out.record;
  record.id = run;
  record.seed = load.seed;
  record.direction = load.direction;
  record.magnitude = load.magnitude;
  record.alpha = load.slope;
  record.beta = load.rotation;
  try {
    const Scene scene = loaded_scene(spec, load);
    Breakup breakup(scene, body, {BreakupSettings::After::chips});
    GrowthRecorder growth;
    SampleRecorder samples;
    breakup.add_observer(growth);
    breakup.add_observer(samples);
    const StopReason stop = breakup.run(scene.run.frames);
    if (stop == StopReason::interrupted) throw Interrupted("interrupted");
    record.frames = breakup.frame();
    record.stop = name(stop);
    record.reason =
        exclusion_reason({record.alpha, record.frames, stop != StopReason::frame_limit,
                          static_cast<std::int32_t>(breakup.cracks()), growth.largest(), body->crack_edge},
                         spec.exclusion);
    out.samples = samples.take();
    for (std::int32_t& id : out.samples.run())
      id = run;
  } catch (const ComputationError& error) {
    record.stop = "failed";
    record.reason = error.what();
  }
  record.excluded = !record.reason.empty();
  record.wall_seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  return out;
}

void generate_database(const DatabaseSpec& spec, const GenerateOptions& options) {
  DatabaseWriter writer(options.out, make_header(spec, options), options.resume);
  const auto body = std::make_shared<const PreparedBody>(prepare(spec.scene));
  std::vector<int> missing;
  for (int run = options.shard - 1; run < spec.runs; run += options.shards)
    if (!writer.has(run)) missing.push_back(run);
  Progress progress("runs", missing.size());
  parallel_for(missing.size(), 1, [&](std::size_t i, std::size_t) {
    throw_if_interrupted();
    const GeneratedRun generated = generate_run(spec, body, missing[i]);
    writer.add(generated.record, generated.samples);
    progress.advance();
  });
  writer.finish();
}

}  // namespace conchoid
