#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <array>
#include <filesystem>
#include <memory>
#include <nlohmann/json.hpp>
#include <numbers>
#include <numeric>

#include "command.hpp"
#include "conchoid/core/error.hpp"
#include "conchoid/core/make_folder.hpp"
#include "conchoid/io/picture.hpp"
#include "conchoid/learn/database.hpp"
#include "conchoid/learn/regressor_kinds.hpp"
#include "conchoid/learn/shipped.hpp"
#include "conchoid/learn/summary.hpp"
#include "conchoid/sim/methods.hpp"
#include "conchoid/study/whole_runs.hpp"
#include "evaluation_text.hpp"

namespace conchoid {
namespace {

struct EvaluateOptions {
  std::string file, samples, specification;
  std::vector<std::string> beside;
  TrainingChoice choice;
  int first = 0, count = 0;  ///< 0: all
  WholeRunSettings whole;
  std::vector<double> tolerances;
  std::string pictures;  ///< folder
  int worst = 10;
};

void one_step(const EvaluateOptions& options, const Regressor& model, bool json) {
  const SampleSet samples =
      read_database(options.samples).samples_to_judge(model.feature_set(), options.choice);
  const Evaluation e = evaluate(model, samples, baseline_predictors());
  print(json ? json_text(e) : one_step_text(e));
}

std::string whole_runs_text(const WholeRuns& runs) {
  std::string text = fmt::format(
      "{} runs left out: too short, or not to be computed\n{:<12} {:<24} {:>4} {:>9} {:>9} {:>9} {:>7} {:>5} "
      "{:>8}",
      runs.left_out, "class", "method", "runs", "median", "95 %", "largest", "frames", "lost", "openings");
  for (const auto& [key, score] : scores(runs))
    text += fmt::format("\n{:<12} {:<24} {:>4} {:>8.2f}% {:>8.2f}% {:>8.2f}% {:>7.2f} {:>5} {:>8.2f}",
                        key.first.empty() ? "all" : key.first, key.second, score.runs, 100 * score.median,
                        100 * score.p95, 100 * score.largest, score.frames_ratio, score.lost,
                        score.opening_ratio);
  return text +
         "\nmean distance of the crack surface from the solved one over the body's diagonal; frames over "
         "those solved, median; runs at the frame limit; seconds of finding openings over those of solving";
}

std::string whole_runs_json(const WholeRuns& runs) {
  nlohmann::ordered_json json;
  json["left_out"] = runs.left_out;
  json["scores"] = nlohmann::json::array();
  for (const auto& [key, score] : scores(runs))
    json["scores"].push_back({{"class", key.first},
                              {"method", key.second},
                              {"runs", score.runs},
                              {"surface_median", score.median},
                              {"surface_p95", score.p95},
                              {"surface_largest", score.largest},
                              {"frames_ratio", score.frames_ratio},
                              {"lost", score.lost},
                              {"opening_ratio", score.opening_ratio}});
  json["runs"] = nlohmann::json::array();
  for (const WholeRun& r : runs.rows)
    json["runs"].push_back({{"run", r.run},
                            {"class", r.body_class},
                            {"method", r.title},
                            {"stop", std::string(name(r.stop))},
                            {"solved_stop", std::string(name(r.solved_stop))},
                            {"frames", {r.solved_frames, r.frames}},
                            {"surface_mean", r.surface},
                            {"surface_over_crack", r.of_crack},
                            {"opening_seconds", {r.solved_seconds, r.seconds}}});
  return json.dump();
}

/// The runs that a method is farthest off on: the solved crack surface beside the method's, in one picture each.
void draw_worst(const EvaluateOptions& options, const DatabaseSpec& spec, const RunMethod& method,
                const WholeRuns& runs) {
  PictureSettings settings;
  settings.width = 840;
  settings.height = 420;
  const std::vector<WholeRun> rows =
      farthest_off(runs, method.title, static_cast<std::size_t>(options.worst));
  const std::vector<CrackSurfaces> all = crack_surfaces(spec, rows, method, options.whole);
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const WholeRun& row = rows[i];
    const CrackSurfaces& surfaces = all[i];
    const auto panel = [&](const TriMesh& crack, const std::string& title, const std::string& caption) {
      PicturePanel out;
      out.meshes = crack_in_body(surfaces.body, crack);
      out.title = title;
      out.caption = caption;
      return out;
    };
    write_picture(
        std::filesystem::path(options.pictures) / fmt::format("{}-{}.png", row.body_class, row.run),
        {panel(surfaces.solved, "Solved",
               fmt::format("{} {}: {}, {} frames", row.body_class, row.run, name(row.solved_stop),
                           row.solved_frames)),
         panel(surfaces.made, method.title,
               fmt::format("{:.1f} % off: {}, {} frames", 100 * row.surface, name(row.stop), row.frames))},
        settings);
  }
}

void runs_of_specification(const EvaluateOptions& options, const Regressor& model, bool json) {
  const DatabaseSpec spec = read_database_spec(options.specification);
  std::vector<std::unique_ptr<Regressor>> others;
  std::vector<RunMethod> methods;
  const auto add = [&](const std::string& file, const Regressor& regressor) {
    const std::string title = std::filesystem::path(file).filename().string();
    methods.push_back({title, std::string(regressor.name()), &regressor});
    for (const double tolerance : options.tolerances)
      methods.push_back({fmt::format("{}, hybrid {}", title, tolerance), "hybrid", &regressor, tolerance});
  };
  constexpr std::array closed_forms = {"steady", "kept", "stress"};
  for (const char* closed_form : closed_forms)
    methods.push_back({closed_form, closed_form, nullptr});
  add(options.file, model);
  for (const std::string& file : options.beside) {
    others.push_back(load_regressor(database_file(file)));
    add(file, *others.back());
  }
  const int count = options.count > 0 ? options.count : spec.runs - options.first;
  if (options.first + count > spec.runs)
    throw InputError(fmt::format("{}: has runs 0 … {}; choose --first and --count among them",
                                 options.specification, spec.runs - 1));
  std::vector<std::int32_t> runs(static_cast<std::size_t>(count));
  std::iota(runs.begin(), runs.end(), options.first);
  if (!options.pictures.empty()) make_folder(options.pictures, "--pictures");  // before the runs
  const WholeRuns result = whole_runs(spec, runs, methods, options.whole);
  print(json ? whole_runs_json(result) : whole_runs_text(result));
  if (!options.pictures.empty()) draw_worst(options, spec, methods[closed_forms.size()], result);
}

}  // namespace

std::string one_step_text(const Evaluation& e) {
  std::vector<Score> scores = {e.model};
  scores.insert(scores.end(), e.baselines.begin(), e.baselines.end());
  std::string text = fmt::format("{} samples of {} runs, {} in the range of the training\n", e.samples,
                                 e.runs, e.model.in_range);
  text += fmt::format("{:<12}{:<{}}root mean square error of Δu/r̄\nmode ", "", "R²", 13 * scores.size());
  for (int part = 0; part < 2; ++part)
    for (const Score& score : scores)
      text += fmt::format(" {:>12}", score.name);
  for (Eigen::Index mode = 0; mode < 3; ++mode) {
    text += fmt::format("\n{:<5}", kModes[static_cast<std::size_t>(mode)]);
    for (const Score& score : scores)
      text += fmt::format(" {:12.4f}", score.accuracy.r2[mode]);
    for (const Score& score : scores)
      text += fmt::format(" {:12.4e}", score.accuracy.rmse[mode]);
  }
  if (e.model.direction_error && e.kept_direction_error)
    text += fmt::format("\nroot mean square error of the direction of K: {:.2f}° (kept: {:.2f}°)",
                        *e.model.direction_error * 180 / std::numbers::pi,
                        *e.kept_direction_error * 180 / std::numbers::pi);
  if (e.seen_in_training)
    text += "\nThese are the samples of the training: the figures of the " + e.model.name + " flatter it.";
  return text;
}

void add_forest_evaluate(CLI::App& group, Invocation& invocation) {
  const auto options = std::make_shared<EvaluateOptions>();
  CLI::App* command = add_command(
      group, invocation, "evaluate", "Accuracy beside the baselines: in one step, or over whole runs",
      [options, &invocation] {
        if (options->samples.empty() == options->specification.empty())
          throw InputError(
              "forest evaluate needs one of --samples FILE (one step) and --runs SPEC (whole runs)");
        const std::unique_ptr<Regressor> model = load_regressor(database_file(options->file));
        options->samples.empty() ? runs_of_specification(*options, *model, invocation.common.json)
                                 : one_step(*options, *model, invocation.common.json);
      });
  add_regressor_argument(*command, options->file);
  command->add_option("--samples", options->samples, "database file (HDF5): accuracy in one step");
  command
      ->add_option("--only", options->choice.only,
                   "classes of bodies whose samples count, with commas between")
      ->delimiter(',');
  command->add_option("--runs", options->specification,
                      "specification as for database generate: its runs are solved, predicted and compared");
  command->add_option("--beside", options->beside, "further files or names to put into the same table")
      ->delimiter(',');
  command->add_flag(
      "--noise-floor", options->whole.noise_floor,
      "with --runs: solve each run again with the load 0.5 % larger, turned by 0.5 degrees, r̄ a tenth "
      "longer, and on other elements: how far that moves the crack is the least that counts");
  command
      ->add_option("--tolerance", options->tolerances,
                   "with --runs: hybrid runs of every regressor with these tolerances, too")
      ->delimiter(',')
      ->check(CLI::NonNegativeNumber);
  command->add_option("--load", options->whole.load, "with --runs: times the load of the specification")
      ->check(CLI::PositiveNumber)
      ->capture_default_str();
  CLI::Option* pictures = command->add_option(
      "--pictures", options->pictures,
      "with --runs: folder for pictures of the runs that FILE is farthest off on, solved beside predicted");
  command->add_option("--worst", options->worst, "so many pictures")
      ->check(CLI::Range(1, 1000))
      ->capture_default_str()
      ->needs(pictures);
  command->add_option("--first", options->first, "first run of the specification")
      ->check(CLI::Range(0, 10000000))
      ->capture_default_str();
  command->add_option("--count", options->count, "number of runs; without it all that follow")
      ->check(CLI::Range(1, 10000000));
}

}  // namespace conchoid
