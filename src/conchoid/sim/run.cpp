#include "conchoid/sim/run.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <memory>

#include "conchoid/core/background_queue.hpp"
#include "conchoid/core/error.hpp"
#include "conchoid/core/hash.hpp"
#include "conchoid/core/log.hpp"
#include "conchoid/core/progress.hpp"
#include "conchoid/core/stopwatch.hpp"
#include "conchoid/core/undisturbed.hpp"
#include "conchoid/sim/body_elements.hpp"
#include "conchoid/sim/breakup.hpp"
#include "conchoid/sim/checkpoint.hpp"
#include "conchoid/sim/load_report.hpp"
#include "conchoid/sim/methods.hpp"
#include "conchoid/sim/recorders.hpp"
#include "conchoid/sim/resolution_warnings.hpp"
#include "conchoid/sim/run_identity.hpp"

namespace conchoid {
namespace {

std::string result_hash(const RunResult& result) {
  ContentHash hash;
  hash.add(name(result.document.stop));
  add_mesh(hash, result.crack);
  for (const Fragment& f : result.fragments)
    add_mesh(hash, f.mesh);
  for (const FrontRow& row : result.front) {
    hash.add(std::array{row.position[0], row.position[1], row.position[2]});
    hash.add(std::array{row.intensity[0], row.intensity[1], row.intensity[2]});
    hash.add(std::array{row.opening[0], row.opening[1], row.opening[2]});
  }
  return hash.hex();
}

// What the run is, before it begins.
RunDocument describe(const Scene& scene, const PreparedBody& body, const RunOptions& options) {
  RunDocument doc;
  doc.scene_file = scene.file;
  doc.scene_text = scene.text;
  doc.method = options.method;
  doc.settings = {
      {"resolution.crack", body.crack_edge},
      {"resolution.surface", body.surface_edge},
      {"run.quadrature_tolerance", scene.run.quadrature_tolerance},
      {"run.frames", static_cast<std::int64_t>(options.frames.value_or(scene.run.frames))},
      {"run.max_cracks", static_cast<std::int64_t>(scene.run.max_cracks)},
      {"run.max_cracks_per_frame", static_cast<std::int64_t>(scene.run.max_cracks_per_frame)},
      {"run.after_separation",
       std::string(scene.run.after_separation == AfterSeparation::stop ? "stop" : "continue")},
      {"run.smallest_body", scene.run.smallest_body},
      {"run.elements", std::string(elements_of(body))},
      {"run.sif", std::string(scene.run.sif == SifSource::two_point ? "two-point" : "one-point")},
      {"run.solve_every", static_cast<std::int64_t>(scene.run.solve_every)},
      {"run.solver", scene.run.solver},
      {"output.formats", fmt::format("{}", fmt::join(options.formats.value_or(scene.output.formats), ","))}};
  if (opening_method(options.method).hybrid)
    doc.settings.push_back(tolerance_setting(options.tolerance.value_or(kStandardTolerance)));
  doc.versions = {{"conchoid", std::string(CONCHOID_VERSION)}, {"compiler", std::string("g++ " __VERSION__)}};
  doc.initial_triangles = body.surface.triangle_count();
  for (const TriMesh& crack : body.cracks)
    doc.initial_triangles += crack.triangle_count();
  if (body.infinite()) return doc;
  Box box = bounding_box(body.detailed);
  box.low += body.origin;
  box.high += body.origin;
  doc.body = box;
  doc.body_volume = enclosed_volume(body.detailed);
  return doc;
}

// Where a run is written.
struct Places {
  std::optional<RunFolder> folder;
  std::optional<Checkpoint> checkpoint;
  std::unique_ptr<BackgroundQueue> queue;  // ends before what it writes to
};

// A checkpoint is read before anything in the folder is touched.
Places open_places(const Fracture& fracture, const Scene& scene, const RunOptions& options) {
  Places places;
  if (!options.folder) return places;
  const std::string identity = run_identity(scene, fracture.body(), fracture.load(), options);
  places.queue = std::make_unique<BackgroundQueue>();
  const auto open_checkpoint = [&](Checkpoint::Earlier earlier) {
    places.checkpoint.emplace(*options.folder, identity, earlier, *places.queue);
  };
  if (options.resume) open_checkpoint(Checkpoint::Earlier::keep);
  places.folder.emplace(*options.folder);
  if (!options.resume) open_checkpoint(Checkpoint::Earlier::remove);
  if (places.checkpoint->frames() > 0)
    message(fmt::format("{}: goes on after frame {}", options.folder->string(), places.checkpoint->frames()));
  return places;
}

void write_results(const RunResult& result, const FragmentFormats& formats, double voxel, RunFolder& folder) {
  folder.write_front_csv(result.front);
  folder.write_crack(result.crack);
  if (!result.fragments.empty())
    folder.write_fragments(result.fragments, formats, result.document.contacts, voxel);
  folder.write_run_json(result.document);
}

void add_warnings(const std::vector<std::string>& warnings, RunDocument& doc) {
  for (const std::string& text : warnings) {
    doc.warnings.push_back(text);
    warning(text);
  }
}

// A line of the report per frame, and the sums over them.
class ReportWriter : public FractureObserver {
 public:
  explicit ReportWriter(RunDocument& document) : doc_(document) {}
  void on_step(const Fracture& fracture, const StepReport& step) override {
    doc_.opening_seconds += step.start_seconds + step.opening_seconds;
    doc_.fracture_seconds += step.fracture_seconds;
    doc_.frames = fracture.frame();
    add_warnings(step.warnings, doc_);
    if (step.frame == 0 || step.stop == StopReason::singular) return;
    FrameRecord record;
    record.frame = step.frame;
    record.source = step.source;
    record.expected_error = step.expected_error;
    if (step.source == "bem") ++doc_.solved_frames;
    if (step.expected_error)
      doc_.expected_error = std::max(doc_.expected_error.value_or(0), *step.expected_error);
    record.crack_triangles = step.crack_triangles;
    record.front_nodes = step.front_points;
    record.crack_area = surface_area(fracture.crack().trimmed);
    record.max_K_eff = step.largest_intensity;
    record.opening_seconds = step.opening_seconds;
    record.fracture_seconds = step.fracture_seconds;
    record.other_seconds = step.other_seconds;
    doc_.timings.push_back(record);
  }

 private:
  RunDocument& doc_;
};

void take_pieces(Breakup& breakup, RunResult& result) {
  RunDocument& doc = result.document;
  Pieces pieces = breakup.take_pieces();
  add_warnings(pieces.warnings, doc);
  result.crack = std::move(pieces.crack);
  result.fragments = std::move(pieces.fragments);
  doc.contacts = std::move(pieces.contacts);
  doc.crack_area = surface_area(result.crack);
  for (const Fragment& f : result.fragments)
    doc.fragments.push_back(fragment_record(f));
}

void add_load(const LoadReport& load, const RunSpec& run, RunDocument& doc) {
  doc.stress_over_strength = load.stress_over_strength();
  doc.largest_K_over_Kc = load.largest_K_over_Kc();
  doc.stop_details = load.details(doc.stop, run);
  add_warnings(load.warnings(doc.stop, run), doc);
}

BreakupSettings breakup_settings(const Scene& scene, const RunOptions& options, const OpeningMethod& method) {
  BreakupSettings settings;
  if (!options.fragments) settings.after = BreakupSettings::After::stop;
  settings.source =
      sources_by(method, scene.run, options.regressor, scene.run.solve_every, options.tolerance);
  return settings;
}

// What the options ask for, checked before anything is computed.
struct Choice {
  const OpeningMethod& method;
  FragmentFormats formats;
};
Choice checked(const Scene& scene, const RunOptions& options) {
  return {checked_method(options.method, options.regressor, options.tolerance),
          formats_from_names(options.formats.value_or(scene.output.formats),
                             options.formats ? "--format" : scene.output.where)};
}

RunResult run_it(const Scene& scene, const std::shared_ptr<const PreparedBody>& body,
                 const RunOptions& options, const Choice& choice, const std::vector<std::string>& said,
                 const Stopwatch& clock) {
  RunResult result;
  RunDocument& doc = result.document = describe(scene, *body, options);
  doc.warnings = said;
  Breakup breakup(scene, body, breakup_settings(scene, options, choice.method));
  add_warnings(resolution_warnings(*body, breakup.fracture().crack(), scene.run.max_cracks > 0), doc);
  Places places = open_places(breakup.fracture(), scene, options);
  std::optional<FrameWriter> frames;
  if (places.checkpoint) {
    doc.resumed_after = places.checkpoint->frames();
    breakup.keep_rows(&*places.checkpoint);
    frames.emplace(*places.folder, *places.queue, scene.output.exaggeration);
    breakup.add_observer(*frames);
    breakup.add_observer(*places.checkpoint);
  }
  FrontRecorder front;
  GrowthRecorder growth;
  SampleRecorder samples(options.measured_samples ? SampleRecorder::Fields::all
                                                  : SampleRecorder::Fields::free);
  LoadReport load;
  ReportWriter report(doc);
  for (FractureObserver* observer :
       std::initializer_list<FractureObserver*>{&front, &growth, &samples, &load, &report})
    breakup.add_observer(*observer);
  const int limit = options.frames.value_or(scene.run.frames);
  std::optional<Progress> progress;
  if (options.progress) progress.emplace("frames", static_cast<std::size_t>(limit));
  doc.stop = breakup.run(limit, [&] {
    if (progress) progress->advance();
  });
  progress.reset();
  doc.final_triangles = breakup.triangles();
  const auto finish = [&] { take_pieces(breakup, result); };
  doc.stop == StopReason::interrupted ? undisturbed(finish) : finish();
  add_load(load, scene.run, doc);
  result.front = front.take();
  result.samples = samples.take();
  result.cracks = static_cast<int>(breakup.cracks());
  result.largest_growth = growth.largest();
  doc.hash = result_hash(result);
  doc.total_seconds = clock.seconds();
  doc.other_seconds = doc.total_seconds - doc.opening_seconds - doc.fracture_seconds;
  if (doc.frames > 0) doc.opening_seconds_per_frame = doc.opening_seconds / doc.frames;
  if (places.folder) {
    places.queue->finish();
    undisturbed([&] {  // a stop that is asked for now comes too late to leave anything out
      write_results(result, choice.formats, body->surface_edge, *places.folder);
    });
  }
  if (places.checkpoint && !may_go_on(doc.stop)) places.checkpoint->remove();
  return result;
}

}  // namespace

RunResult run_scene(const Scene& scene, const RunOptions& options) {
  return run_body(scene, scene_body(scene), options);
}

RunResult run_body(const Scene& scene, Body of_scene, const RunOptions& options) {
  const Choice choice = checked(scene, options);
  const Stopwatch clock;
  const std::vector<std::string> said = of_scene.warnings;
  const auto body = std::make_shared<const PreparedBody>(prepare(scene, std::move(of_scene)));
  return run_it(scene, body, options, choice, said, clock);
}

RunResult run_prepared(const Scene& scene, const std::shared_ptr<const PreparedBody>& body,
                       const RunOptions& options) {
  return run_it(scene, body, options, checked(scene, options), {}, Stopwatch());
}

}  // namespace conchoid
