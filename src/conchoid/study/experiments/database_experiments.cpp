#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "conchoid/core/progress.hpp"
#include "conchoid/learn/evaluate.hpp"
#include "conchoid/learn/forest.hpp"
#include "conchoid/learn/summary.hpp"
#include "conchoid/sim/methods.hpp"
#include "conchoid/study/experiments/experiments.hpp"
#include "conchoid/study/experiments/method_comparison.hpp"
#include "conchoid/study/experiments/published_scenes.hpp"

namespace conchoid {
namespace {

constexpr std::array kModes = {"I", "II", "III"};

std::string scientific(double value) {
  return fmt::format("{:.3e}", value);
}

// How far the samples of a database are driven: K_eff / K_c.
std::vector<double> drives(const SampleSet& samples) {
  std::vector<double> out;
  for (std::size_t i = 0; i < samples.size(); ++i) {
    const Sample s = samples[i];
    out.push_back(std::sqrt(s.K[0] * s.K[0] + s.K[1] * s.K[1] + s.K[2] * s.K[2] / (1 - s.poisson_ratio)) /
                  s.toughness);
  }
  std::sort(out.begin(), out.end());
  return out;
}

std::string drive_sentence(const std::string& title, const Database& database) {
  const std::vector<double> drive = drives(database.training_samples());
  if (drive.empty()) return fmt::format("{}: no samples.", title);
  return fmt::format("{}: K_eff/K_c has the median {:.3g}, the first percentile {:.3g}.", title,
                     drive[drive.size() / 2], drive[drive.size() / 100]);
}

ReportTable intensity_table(const std::string& name, const std::string& caption, const Database& database) {
  ReportTable table{name, caption, {"", "K_I", "K_II", "K_III"}, {}};
  const DatabaseStatistics s = database_statistics(database);
  const auto row = [&](const char* title, double Statistics::*value) {
    table.rows.push_back(
        {title, scientific(s.K[0].*value), scientific(s.K[1].*value), scientific(s.K[2].*value)});
  };
  row("median, Pa√m", &Statistics::median);
  row("mean, Pa√m", &Statistics::mean);
  row("coefficient of variation", &Statistics::coefficient_of_variation);
  table.rows.push_back({"samples", fmt::format("{}", s.samples), "", ""});
  return table;
}

Findings table_1(Workshop& workshop) {
  const Database& published = workshop.database(cube_database(workshop.scale()));
  const Database& near = workshop.database(
      cube_database(workshop.scale(), {.toughness = kNearToughness, .noisy_toughness = true}));
  Findings f;
  f.tables.push_back(intensity_table("cube", "Cube database as published, K_c = 1e6 Pa√m", published));
  f.tables.push_back(intensity_table(
      "cube-near-toughness", "The same loads with K_c = 2e7 Pa√m, varied by ± 40 % within the body", near));
  f.remarks = {drive_sentence("As published", published), drive_sentence("With K_c raised and varied", near),
               "As published every front always moves by r̄, whatever the load and K_c are: the database is "
               "over-driven."};
  return f;
}

struct NamedDatabase {
  std::string title, text;
  ForestChoice forest;
};

std::vector<std::string> database_row(Workshop& workshop, const NamedDatabase& named) {
  const DatabaseInfo info = database_info(workshop.database(named.text));
  const TrainedForest& forest = workshop.forest(named.text, named.forest);
  return {named.title,
          fmt::format("{}", info.runs),
          fmt::format("{}", info.training_samples - info.new_node_samples),  // as published
          fmt::format("({},{})", named.forest.trees, named.forest.depth),
          number_text(info.wall_seconds),
          number_text(forest.seconds),
          fmt::format("{:.1f}", info.mean_frames),
          fmt::format("{}", info.excluded_runs)};
}

Findings table_2(Workshop& workshop) {
  const StudyScale scale = workshop.scale();
  std::vector<NamedDatabase> databases = {
      {"Cube", cube_database(scale), {.trees = 50, .depth = 10}},
      {"Cube", cube_database(scale), {.trees = 25, .depth = 15}},
      {"Cube, fewer runs", small_cube_database(scale), {.trees = 50, .depth = 10}},
      {"Cylinder", cylinder_database(scale), {.trees = 50, .depth = 10}},
      {"Bar", bar_database(scale), {.trees = 50, .depth = 10}}};
  Findings f;
  if (!workshop.armadillo().empty())
    databases.push_back(
        {"Armadillo", armadillo_database(workshop.armadillo(), scale), {.trees = 10, .depth = 10}});
  else
    f.remarks.push_back("The Armadillo's database is left out: no scan was given (--armadillo).");
  ReportTable table{
      "databases",
      "Databases and forests; seconds of all runs together, and of the training",
      {"database", "runs", "samples", "(t,d)", "generation s", "training s", "frames / run", "excluded runs"},
      {}};
  for (const NamedDatabase& named : databases)
    table.rows.push_back(database_row(workshop, named));
  f.tables.push_back(std::move(table));
  return f;
}

std::vector<std::string> evaluation_row(const std::string& title, const Score& score) {
  std::vector<std::string> row = {title};
  for (int mode = 0; mode < 3; ++mode)
    row.push_back(number_text(score.accuracy.r2[mode]));
  for (int mode = 0; mode < 3; ++mode)
    row.push_back(number_text(score.accuracy.rmse[mode]));
  return row;
}

std::vector<std::string> evaluation_columns(const std::string& first) {
  std::vector<std::string> columns = {first};
  for (const char* quantity : {"R²", "RMSE"})
    for (const char* mode : kModes)
      columns.push_back(fmt::format("{} {}", quantity, mode));
  return columns;
}

// One-step accuracy of the published feature sets, trained on one database, on held-out runs of another.
ReportTable feature_table(Workshop& workshop, const std::string& name, const std::string& caption,
                          const std::string& database, const std::string& held_out) {
  ReportTable table{name, caption, evaluation_columns("features"), {}};
  const SampleSet samples = workshop.database(held_out).training_samples();
  for (const char* features : {"paper-3", "paper-4", "paper-5", "dimensionless"}) {
    const TrainedForest& forest = workshop.forest(database, {.trees = 10, .depth = 10, .features = features});
    table.rows.push_back(evaluation_row(features, score(*forest.regressor, samples)));
  }
  table.rows.push_back(evaluation_row("steady (no training)", score(steady_predictor(), samples)));
  return table;
}

std::vector<MethodChoice> feature_forests(Workshop& workshop, const std::string& database) {
  std::vector<MethodChoice> methods;
  for (const char* features : {"paper-3", "paper-4", "paper-5"})
    methods.push_back(
        {.title = features,
         .method = "forest",
         .regressor =
             workshop.forest(database, {.trees = 10, .depth = 10, .features = features}).regressor.get()});
  return methods;
}

Findings figure_13(Workshop& workshop) {
  const StudyScale scale = workshop.scale();
  const Variant near{.toughness = kNearToughness, .noisy_toughness = true};
  const std::string published = magnitude_database(scale), varied = magnitude_database(scale, near);
  const ComparedScene scene{"Cube 45", cube_scene(45)},
      near_scene{"Cube 45, K_c near the load", cube_scene(45, near)};
  Findings f;
  std::vector<MethodChoice> methods = feature_forests(workshop, published);
  f.pictures.push_back(pieces_picture(workshop, "figure-13", scene, methods));
  const std::vector<MethodChoice> free_of_training = baselines();
  methods.insert(methods.end(), free_of_training.begin(), free_of_training.end());
  f.tables.push_back(comparison_table(workshop, {scene}, methods));
  methods = feature_forests(workshop, varied);
  methods.insert(methods.end(), free_of_training.begin(), free_of_training.end());
  f.tables.push_back(comparison_table(workshop, {near_scene}, methods));
  f.tables.back().name = "comparison-near-toughness";
  f.tables.back().caption = "The same with K_c = 2e7 Pa√m, varied by ± 40 %, in training and scene";
  f.tables.push_back(feature_table(workshop, "one-step", "One step, held-out cubes; of Δu/r̄", published,
                                   held_out_cubes(scale)));
  f.tables.push_back(feature_table(workshop, "one-step-near-toughness",
                                   "One step, held-out cubes, K_c = 2e7 Pa√m, varied by ± 40 %", varied,
                                   held_out_cubes(scale, near)));
  f.remarks = {
      "As published the loads differ in magnitude alone, K_c is the same everywhere and far exceeded: 3 and "
      "4 "
      "features give the same forest, and the database holds one run many times. The second version varies "
      "K_c.",
      "One-step R² does not rank whole runs: read it beside the table of the scenes only."};
  return f;
}

// Evenly drawn samples: every n-th.
SampleSet thinned(const SampleSet& samples, std::size_t count) {
  if (count >= samples.size()) return samples;
  std::vector<std::size_t> indices;
  for (std::size_t i = 0; i < count; ++i)
    indices.push_back(i * samples.size() / count);
  return samples.subset(indices);
}

struct MeanAndSpread {
  double mean = 0, spread = 0;
};

MeanAndSpread mean_and_spread(const std::vector<double>& values) {
  const auto n = static_cast<double>(values.size());
  MeanAndSpread out;
  for (const double v : values)
    out.mean += v / n;
  for (const double v : values)
    out.spread += (v - out.mean) * (v - out.mean) / n;
  out.spread = std::sqrt(out.spread);
  return out;
}

Findings tree_study(Workshop& workshop) {
  const StudyScale scale = workshop.scale();
  const SampleSet all = workshop.database(cube_database(scale)).training_samples();
  const SampleSet held_out = workshop.database(held_out_cubes(scale)).training_samples();
  const std::vector<std::size_t> sizes = workshop.full()
                                             ? std::vector<std::size_t>{10'000, 100'000, 1'000'000}
                                             : std::vector<std::size_t>{100, 300, 1000};
  constexpr std::array kTrees = {5, 10, 25, 50};
  constexpr std::array kDepths = {5, 10, 15, 20};
  constexpr std::uint64_t kSeeds = 3;
  ReportTable table{
      "trees",
      "R² of Δu/r̄ (mean of the modes), mean over three seeds of the training, with their standard "
      "deviation: more trees are steadier, deeper ones fit the training better",
      {"samples", "trees", "depth", "held out", "spread over seeds", "training"},
      {}};
  std::vector<ReportPlot> plots;
  Progress progress("forests", sizes.size() * kTrees.size() * kDepths.size() * kSeeds);
  for (const std::size_t size : sizes) {
    const SampleSet training = thinned(all, size);
    ReportPlot plot{fmt::format("{} samples", training.size()), "depth", "R², held out", false, false, {}};
    for (const int trees : kTrees) {
      PlotSeries series{fmt::format("{} trees", trees), {}};
      for (const int depth : kDepths) {
        std::vector<double> outside, inside;
        for (std::uint64_t seed = 1; seed <= kSeeds; ++seed) {
          const RegressionForest forest = RegressionForest::train(
              training,
              {.trees = trees, .depth = depth, .features = FeatureSet::paper_4, .seed = seed, .bins = 256});
          outside.push_back(score(forest, held_out).accuracy.r2.mean());
          inside.push_back(score(forest, training).accuracy.r2.mean());
          progress.advance();
        }
        const MeanAndSpread out = mean_and_spread(outside), in = mean_and_spread(inside);
        table.rows.push_back({fmt::format("{}", training.size()), fmt::format("{}", trees),
                              fmt::format("{}", depth), number_text(out.mean), number_text(out.spread),
                              number_text(in.mean)});
        series.points.push_back({static_cast<double>(depth), out.mean});
      }
      plot.series.push_back(std::move(series));
    }
    plots.push_back(std::move(plot));
    if (training.size() == all.size()) break;
  }
  Findings f;
  f.tables.push_back(std::move(table));
  f.plots = std::move(plots);
  f.remarks = {"Whole runs are held out. One-step R² does not rank whole runs."};
  return f;
}

}  // namespace

std::vector<Experiment> database_experiments() {
  return {
      {.name = "table-1",
       .title = "Table 1: K over the samples of the Cube database",
       .outcome = "K_I dominates, K_III is small and varies most.",
       .published = {{"published",
                      "As published",
                      {"", "K_I", "K_II", "K_III"},
                      {{"median, Pa√m", "1.452e+07", "-1.400e+06", "8.125e+04"},
                       {"mean, Pa√m", "1.661e+07", "-2.373e+06", "6.537e+04"},
                       {"coefficient of variation", "0.849", "-2.17", "27.6"}}}},
       .make = table_1},
      {.name = "table-2",
       .title = "Table 2: databases and forests",
       .outcome = "Hours to generate, up to half a day to train.",
       .published = {{"published",
                      "As published",
                      {"database", "runs", "samples", "(t,d)", "generation", "training"},
                      {{"Cube", "7502", "992976", "(50,10)", "1 h 25 min", "44 min"},
                       {"Cube", "7502", "992976", "(25,15)", "", "13 h 22 min"},
                       {"Cube, fewer runs", "3001", "411806", "", "", ""},
                       {"Cylinder", "3001", "492373", "(50,10)", "3 h 30 min", "1 h 20 min"},
                       {"Armadillo", "151", "12611", "(10,10)", "", ""},
                       {"Bar", "151", "71323", "(50,10)", "", ""}}}},
       .make = table_2},
      {.name = "figure-13",
       .title = "Figure 13: the cube with 3, 4 and 5 features",
       .outcome = "4 and 5 features better than 3 (9,328 samples, magnitude only, (10,10)).",
       .published = {},
       .make = figure_13},
      {.name = "tree-study",
       .title = "Number and depth of the trees, 1e4 to 1e6 samples",
       .outcome = "More trees are steadier; depth 10 … 15 against overfitting.",
       .published = {},
       .make = tree_study},
  };
}

}  // namespace conchoid
