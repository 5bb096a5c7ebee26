#include "conchoid/study/experiments/workshop.hpp"

#include <fmt/format.h>

#include <chrono>
#include <fstream>
#include <optional>

#include "conchoid/core/atomic_file.hpp"
#include "conchoid/core/byte_cache.hpp"
#include "conchoid/core/error.hpp"
#include "conchoid/core/interrupt.hpp"
#include "conchoid/core/make_folder.hpp"
#include "conchoid/core/parallel.hpp"
#include "conchoid/core/progress.hpp"
#include "conchoid/learn/database_provenance.hpp"
#include "conchoid/learn/regressor_kinds.hpp"
#include "conchoid/sim/generate.hpp"
#include "conchoid/sim/run.hpp"

namespace conchoid {
namespace {

namespace fs = std::filesystem;

// Seconds of a training, beside its forest.
void write_seconds(const fs::path& file, double seconds) {
  AtomicFile out(file);
  out.stream() << fmt::format("{}\n", seconds);
  out.commit();
}

double read_seconds(const fs::path& file) {
  double seconds = 0;
  std::ifstream in(file);
  in >> seconds;
  return seconds;
}

std::string scene_text(const std::string& text, const MethodChoice& method) {
  return method.solve_every > 0 ? text + fmt::format("solve_every = {}\n", method.solve_every) : text;
}

bool finished(const fs::path& run_folder) {
  const fs::path report = run_folder / "run.json";
  return fs::exists(report) && read_run_json(report).stop != StopReason::interrupted;
}

std::string made_from(const std::string& text, const MethodChoice& method) {
  const std::string made =
      fmt::format("{}\n{}\n{}\n{}", scene_text(text, method), method.method,
                  method.regressor ? method.regressor->content_hash() : 0, method.frames);
  return method.tolerance ? fmt::format("{}\n{}", made, *method.tolerance) : made;
}

}  // namespace

StudyScale study_scale_from_name(const std::string& name) {
  if (name == "smoke") return StudyScale::smoke;
  if (name == "full") return StudyScale::full;
  throw InputError(fmt::format("--scale {}: choose smoke or full", name));
}

std::string_view name(StudyScale scale) {
  return scale == StudyScale::smoke ? "smoke" : "full";
}

Workshop::Workshop(fs::path folder, StudyScale scale, fs::path armadillo)
    : folder_(std::move(folder)), armadillo_(std::move(armadillo)), scale_(scale) {
  for (const char* part : {"cache", "figures", "tables"})
    make_folder(folder_ / part, "--out");
  prepared_ = std::make_shared<const ByteCache>(folder_ / "cache" / "prepared");
}

fs::path Workshop::cached(const std::string& kind, const std::string& made_from) const {
  return folder_ / "cache" / cache_name(kind, made_from);
}

const Database& Workshop::database(const std::string& text) {
  specifications_.insert(text);
  const auto found = databases_.find(text);
  if (found != databases_.end()) return found->second;
  const fs::path file = cached("database", text).concat(".h5");
  DatabaseSpec spec = parse_database_spec(text, "experiment", folder_);
  spec.scene.run.cache = prepared_;
  generate_database(spec, {.out = file, .resume = true});
  return databases_.emplace(text, read_database(file)).first->second;
}

const TrainedForest& Workshop::forest(const std::string& database_text, const ForestChoice& choice) {
  specifications_.insert(database_text);
  const std::string key =
      fmt::format("{}\n{} {} {} {}", database_text, choice.trees, choice.depth, choice.features, choice.seed);
  const auto found = forests_.find(key);
  if (found != forests_.end()) return found->second;
  const fs::path file = cached("forest", key).concat(".forest"), seconds = fs::path(file).concat(".seconds");
  if (!fs::exists(file)) {
    const Database& database = this->database(database_text);
    TrainingSettings settings;
    settings.features = feature_set_from_name(choice.features);
    settings.seed = choice.seed;
    settings.options = {{"trees", choice.trees}, {"depth", choice.depth}};
    std::optional<Progress> progress;
    const auto start = std::chrono::steady_clock::now();
    const auto trained = train_regressor(regressor_kind("forest"), database.training_samples(), settings,
                                         provenance_of(database.header), [&](int, int total) {
                                           throw_if_interrupted();
                                           if (!progress)
                                             progress.emplace("training", static_cast<std::size_t>(total));
                                           progress->advance();
                                         });
    write_seconds(seconds, std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count());
    trained->save(file);
  }
  return forests_.emplace(key, TrainedForest{load_regressor(file), read_seconds(seconds)}).first->second;
}

fs::path Workshop::run_folder(const std::string& text, const MethodChoice& method) const {
  return cached("run", made_from(text, method));
}

const RunData& Workshop::run(const std::string& text, const MethodChoice& method) {
  throw_if_interrupted();
  const fs::path folder = run_folder(text, method);
  const auto found = runs_.find(folder.string());
  if (found != runs_.end()) return found->second;
  make_run(text, method);
  return runs_.emplace(folder.string(), read_run(folder)).first->second;
}

void Workshop::make_runs(const std::vector<RunChoice>& runs) const {
  parallel_for(runs.size(), 1, [&](std::size_t i, std::size_t) {
    throw_if_interrupted();
    make_run(runs[i].text, runs[i].method);
  });
}

void Workshop::make_run(const std::string& text, const MethodChoice& method) const {
  const fs::path folder = run_folder(text, method);
  if (finished(folder)) return;
  RunOptions options;
  options.method = method.method;
  options.regressor = method.regressor;
  options.tolerance = method.tolerance;
  if (method.frames > 0) options.frames = method.frames;
  options.folder = folder;
  options.resume = true;
  options.progress = false;
  Scene scene = parse_scene(scene_text(text, method), "experiment", folder_);
  scene.run.cache = prepared_;
  if (method.method == "bem") prepare(scene);  // so that its time, too, is without preparing the body
  const RunResult result = run_scene(scene, options);
  if (result.document.stop == StopReason::interrupted) throw Interrupted("interrupted");
}

fs::path Workshop::picture_file(const std::string& name) const {
  return folder_ / "figures" / (name + ".png");
}

}  // namespace conchoid
