#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <memory>
#include <nlohmann/json.hpp>

#include "command.hpp"
#include "conchoid/core/error.hpp"
#include "conchoid/learn/database.hpp"
#include "conchoid/learn/evaluate.hpp"
#include "conchoid/learn/inspection.hpp"
#include "conchoid/learn/regressor_kinds.hpp"
#include "conchoid/learn/shipped.hpp"
#include "conchoid/learn/tree_ensemble.hpp"
#include "conchoid/sim/methods.hpp"
#include "conchoid/sim/run.hpp"

namespace conchoid {
namespace {

using nlohmann::ordered_json;

struct InspectOptions {
  std::string file, samples, scene, training, cache;
};

ordered_json per_mode(const Vec3& v) {
  return {{"I", v[0]}, {"II", v[1]}, {"III", v[2]}};
}

/// Sizes of the trees and how often each feature decides, per mode; null for what has no trees.
ordered_json trees_json(const Regressor& regressor) {
  const std::vector<std::string> names = feature_names(regressor.feature_set());
  ordered_json modes;
  for (int mode = 0; mode < 3; ++mode) {
    std::vector<std::size_t> splits(names.size(), 0);
    std::size_t leaves = 0, trees = 0, nodes = 0;
    int depth = 0;
    const std::vector<const TreeEnsemble*> ensembles = regressor.ensembles(mode);
    if (ensembles.empty()) return nullptr;
    for (const TreeEnsemble* ensemble : ensembles) {
      for (const RegressionTree& tree : ensemble->trees())
        for (std::size_t i = 0; i < tree.size(); ++i)
          tree.left[i] < 0 ? ++leaves : ++splits[static_cast<std::size_t>(tree.feature[i])];
      trees += ensemble->tree_count();
      nodes += ensemble->node_count();
      depth = std::max(depth, ensemble->depth());
    }
    ordered_json& m = modes[kModes[static_cast<std::size_t>(mode)]];
    m["trees"] = trees;
    m["depth"] = depth;
    m["nodes"] = nodes;
    m["leaves"] = leaves;
    for (std::size_t f = 0; f < names.size(); ++f)
      m["splits"][names[f]] = splits[f];
  }
  return modes;
}

ordered_json influences_json(const Regressor& regressor, const SampleSet& samples) {
  auto out = ordered_json::array();
  for (const FeatureInfluence& f : feature_influences(regressor, samples)) {
    ordered_json one = {{"name", f.name}, {"importance", per_mode(f.importance)}};
    for (const FeatureInfluence::Dependence& d : f.dependence)
      one["dependence"].push_back({{"value", d.value}, {"label", per_mode(d.mean)}});
    out.push_back(std::move(one));
  }
  return out;
}

ordered_json coverage_json(const Regressor& regressor, const SampleSet& samples) {
  const RangeCoverage c = range_coverage(regressor, samples);
  ordered_json out = {{"samples", c.samples}, {"in_range", c.in_range}};
  for (const RangeCoverage::Feature& f : c.features)
    out["features"].push_back({{"name", f.name},
                               {"outside", f.outside},
                               {"in_the_tails", f.in_the_tails},
                               {"median", f.median},
                               {"training_median", f.training_median}});
  return out;
}

ordered_json neighbours_json(const NeighbourCoverage& c) {
  return {{"covered", c.covered},
          {"median", c.median},
          {"p95", c.p95},
          {"own_median", c.own_median},
          {"own_p95", c.own_p95},
          {"labels_apart", per_mode(c.labels_apart)},
          {"own_labels_apart", per_mode(c.own_labels_apart)}};
}

ordered_json accuracy_json(const Regressor& regressor, const SampleSet& samples) {
  ordered_json out;
  std::vector<const OpeningPredictor*> predictors = baseline_predictors();
  predictors.insert(predictors.begin(), &regressor);
  for (const OpeningPredictor* predictor : predictors) {
    const Score s = score(*predictor, samples);
    out[s.name] = {{"r2", per_mode(s.accuracy.r2)}, {"rmse", per_mode(s.accuracy.rmse)}};
  }
  return out;
}

SampleSet samples_for(const Regressor& regressor, const std::string& database) {
  return read_database(database).samples_to_judge(regressor.feature_set());
}

// Of a database, or of a scene solved by boundary elements.
SampleSet inspected_samples(const Regressor& regressor, const InspectOptions& options) {
  if (!options.samples.empty()) return samples_for(regressor, options.samples);
  if (options.scene.empty()) return {};
  Scene scene = read_scene(options.scene);
  scene.run.cache = open_cache(options.cache);
  RunOptions run;
  run.fragments = false;
  run.measured_samples = regressor.looks_around();
  return run_scene(scene, run).samples;
}

ordered_json inspection(const InspectOptions& options) {
  const std::unique_ptr<Regressor> regressor = load_regressor(database_file(options.file));
  ordered_json out;
  out["modes"] = trees_json(*regressor);
  if (options.samples.empty() && options.scene.empty()) {
    if (!options.training.empty())
      throw InputError(
          "--training goes with --samples or --scene, whose samples it is compared with; add one");
    if (!out["modes"].is_null()) return out;
    throw InputError(
        fmt::format("{}: holds a {}, which has no trees to inspect; add --samples or --scene, or "
                    "use `conchoid forest info`",
                    options.file, regressor_kind(regressor->name()).title));
  }
  const SampleSet samples = inspected_samples(*regressor, options);
  out["features"] = influences_json(*regressor, samples);
  out["coverage"] = coverage_json(*regressor, samples);
  if (!options.training.empty())
    out["coverage"]["neighbours"] =
        neighbours_json(neighbour_coverage(*regressor, samples_for(*regressor, options.training), samples));
  out["accuracy"] = accuracy_json(*regressor, samples);
  return out;
}

std::string trees_text(const ordered_json& modes) {
  std::string text;
  for (const auto& [mode, m] : modes.items()) {
    text += fmt::format("mode {}: {} trees, depth {}, {} nodes, {} leaves; splits by feature:\n", mode,
                        m["trees"].get<int>(), m["depth"].get<int>(), m["nodes"].get<std::size_t>(),
                        m["leaves"].get<std::size_t>());
    for (const auto& [feature, count] : m["splits"].items())
      text += fmt::format("  {:<28} {}\n", feature, count.get<std::size_t>());
  }
  return text;
}

std::string influences_text(const ordered_json& features) {
  std::string text = fmt::format("\n{:<30}importance: R² lost without it\n{:<30}", "", "feature");
  for (const char* mode : kModes)
    text += fmt::format("{:>10}", mode);
  for (const auto& f : features) {
    text += fmt::format("\n  {:<28}", f["name"].get<std::string>());
    for (const char* mode : kModes)
      text += fmt::format("{:10.3f}", f["importance"][mode].get<double>());
  }
  text += "\n\nmean label where the feature has a value (quantiles of the training)\n";
  for (const auto& f : features) {
    text += fmt::format("  {}\n", f["name"].get<std::string>());
    for (const auto& d : f["dependence"]) {
      text += fmt::format("    {:>14.4e}", d["value"].get<double>());
      for (const char* mode : kModes)
        text += fmt::format("{:12.4f}", d["label"][mode].get<double>());
      text += "\n";
    }
  }
  return text;
}

std::string coverage_text(const ordered_json& c) {
  std::string text =
      fmt::format("\ncoverage: {} of {} samples in the range of the training\n{:<30}{:>10}{:>10}{:>14}{:>14}",
                  c["in_range"].get<std::size_t>(), c["samples"].get<std::size_t>(), "feature", "outside",
                  "in tails", "median", "of training");
  for (const auto& f : c["features"])
    text += fmt::format("\n  {:<28}{:9.1f}%{:9.1f}%{:14.4e}{:14.4e}", f["name"].get<std::string>(),
                        100 * f["outside"].get<double>(), 100 * f["in_the_tails"].get<double>(),
                        f["median"].get<double>(), f["training_median"].get<double>());
  if (!c.contains("neighbours")) return text;
  const auto& n = c["neighbours"];
  text += fmt::format(
      "\n{:.1f} % of the samples have a neighbour in the training as near as its own have"
      "\ndistance of the nearest: median {:.4f}, 95 % {:.4f}; within the training {:.4f}, {:.4f}"
      "\nlabel against that of the nearest, over the labels' deviation; within the training",
      100 * n["covered"].get<double>(), n["median"].get<double>(), n["p95"].get<double>(),
      n["own_median"].get<double>(), n["own_p95"].get<double>());
  for (const char* mode : kModes)
    text += fmt::format("\n  {:<28}{:10.3f}{:10.3f}", mode, n["labels_apart"][mode].get<double>(),
                        n["own_labels_apart"][mode].get<double>());
  return text;
}

std::string accuracy_text(const ordered_json& scores) {
  std::string text = "\n\nR² of Δu/r̄";
  for (const auto& [name, s] : scores.items()) {
    text += fmt::format("\n  {:<28}", name);
    for (const char* mode : kModes)
      text += fmt::format("{:10.3f}", s["r2"][mode].get<double>());
  }
  return text;
}

std::string inspection_text(const ordered_json& inspection) {
  std::string text = trees_text(inspection["modes"]);
  if (!inspection.contains("features")) {
    text.pop_back();
    return text;
  }
  return text + influences_text(inspection["features"]) + coverage_text(inspection["coverage"]) +
         accuracy_text(inspection["accuracy"]);
}

}  // namespace

void add_forest_inspect(CLI::App& group, Invocation& invocation) {
  const auto options = std::make_shared<InspectOptions>();
  CLI::App* command = add_command(
      group, invocation, "inspect",
      "What the trees split on; with samples, what each feature does and how far they are covered",
      [options, &invocation] {
        const ordered_json json = inspection(*options);
        print(invocation.common.json ? json.dump() : inspection_text(json));
      });
  add_regressor_argument(*command, options->file);
  CLI::Option* samples =
      command->add_option("--samples", options->samples, "database file (HDF5) to inspect it by");
  command
      ->add_option("--scene", options->scene,
                   "scene file (TOML), solved by boundary elements, to inspect it by")
      ->excludes(samples);
  command->add_option(
      "--training", options->training,
      "database file that it was trained on: tells how near its samples are to those of the scene");
  add_cache_option(*command, options->cache);
}

}  // namespace conchoid
