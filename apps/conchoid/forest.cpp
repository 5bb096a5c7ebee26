#include "conchoid/learn/forest.hpp"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <memory>
#include <nlohmann/json.hpp>

#include "command.hpp"
#include "conchoid/core/interrupt.hpp"
#include "conchoid/core/log.hpp"
#include "conchoid/core/progress.hpp"
#include "conchoid/learn/database.hpp"
#include "conchoid/learn/evaluate.hpp"
#include "conchoid/learn/summary.hpp"

namespace conchoid {
namespace {

using nlohmann::ordered_json;
constexpr std::array kModes = {"I", "II", "III"};

struct ForestOptions {
  std::string file, samples, out, features = "paper-4";
  ForestSettings settings;
  double hold_out = 0;
};

std::string evaluation_text(const Evaluation& e) {
  std::string text = fmt::format(
      "{} samples of {} runs, {} in the range of the training\n"
      "            R²                        root mean square error of Δu/r̄\n"
      "mode        forest       steady       forest       steady",
      e.samples, e.runs, e.in_range);
  for (Eigen::Index mode = 0; mode < 3; ++mode)
    text += fmt::format("\n{:<5} {:12.4f} {:12.4f} {:12.4e} {:12.4e}", kModes[static_cast<std::size_t>(mode)],
                        e.forest.r2[mode], e.baseline_steady.r2[mode], e.forest.rmse[mode],
                        e.baseline_steady.rmse[mode]);
  if (e.seen_in_training)
    text += "\nThese are the samples the forest was trained on: its figures flatter it.";
  return text;
}

std::string forest_text(const RegressionForest& forest) {
  const ForestSettings& s = forest.settings();
  const Provenance& p = forest.provenance();
  std::string text = fmt::format(
      "features    {}\ntrees       {} of depth {} per mode\ntrained on  {} samples of {} runs ({})",
      name(s.features), s.trees, s.depth, p.samples, p.runs, fmt::join(p.models, ", "));
  const std::vector<std::string> names = feature_names(s.features);
  for (std::size_t i = 0; i < names.size(); ++i)
    text += fmt::format("\n  {:<28} {:12.4e} … {:12.4e}", names[i], forest.ranges()[i].minimum,
                        forest.ranges()[i].maximum);
  return text;
}

Provenance provenance_of(const DatabaseHeader& header) {
  Provenance provenance;
  provenance.models = header.models;
  provenance.material = header.material;
  provenance.resolution = header.resolution;
  provenance.spec = header.spec;
  return provenance;
}

void train(ForestOptions options, const CommonOptions& common) {
  options.settings.features = feature_set_from_name(options.features);
  const Database database = read_database(options.samples);
  if (!database.complete())
    warning(options.samples + ": some planned runs are missing; the forest learns from what is there");
  Split split{database.training_samples(), {}};
  if (options.hold_out > 0) split = split_by_run(split.training, options.hold_out, options.settings.seed);

  Progress progress("trees", static_cast<std::size_t>(options.settings.trees) * 3);
  const auto on_tree = [&](int, int) {
    throw_if_interrupted();
    progress.advance();
  };
  const RegressionForest forest =
      RegressionForest::train(split.training, options.settings, provenance_of(database.header), on_tree);
  forest.save(options.out);

  if (split.held_out.empty()) return print(common.json ? json_text(forest) : forest_text(forest));
  const Evaluation held_out = evaluate(forest, split.held_out);
  if (!common.json) return print(forest_text(forest) + "\n\nheld out: " + evaluation_text(held_out));
  ordered_json json = ordered_json::parse(json_text(forest));
  json["held_out"] = ordered_json::parse(json_text(held_out));
  print(json.dump());
}

/// Sizes of the trees and how often each feature decides, per mode.
ordered_json inspection(const RegressionForest& forest) {
  const std::vector<std::string> names = feature_names(forest.settings().features);
  ordered_json modes;
  for (int mode = 0; mode < 3; ++mode) {
    std::vector<std::size_t> splits(names.size(), 0);
    std::size_t leaves = 0;
    for (const RegressionTree& tree : forest.ensemble(mode).trees())
      for (std::size_t i = 0; i < tree.size(); ++i)
        tree.left[i] < 0 ? ++leaves : ++splits[static_cast<std::size_t>(tree.feature[i])];
    ordered_json& m = modes[kModes[static_cast<std::size_t>(mode)]];
    m["trees"] = forest.ensemble(mode).tree_count();
    m["depth"] = forest.ensemble(mode).depth();
    m["nodes"] = forest.ensemble(mode).node_count();
    m["leaves"] = leaves;
    for (std::size_t f = 0; f < names.size(); ++f)
      m["splits"][names[f]] = splits[f];
  }
  return ordered_json{{"modes", modes}};
}

std::string inspection_text(const ordered_json& inspection) {
  std::string text;
  for (const auto& [mode, m] : inspection["modes"].items()) {
    text += fmt::format("{}mode {}: {} trees, depth {}, {} nodes, {} leaves; splits by feature:",
                        text.empty() ? "" : "\n", mode, m["trees"].get<int>(), m["depth"].get<int>(),
                        m["nodes"].get<std::size_t>(), m["leaves"].get<std::size_t>());
    for (const auto& [feature, count] : m["splits"].items())
      text += fmt::format("\n  {:<28} {}", feature, count.get<std::size_t>());
  }
  return text;
}

void add_train(CLI::App& group, Invocation& invocation, const std::shared_ptr<ForestOptions>& options) {
  CLI::App* command = add_command(group, invocation, "train", "Train three regression forests, one per mode",
                                  [options, &invocation] { train(*options, invocation.common); });
  ForestSettings& s = options->settings;
  std::vector<std::string> sets;
  for (FeatureSet set : all_feature_sets())
    sets.emplace_back(name(set));
  command->add_option("SAMPLES", options->samples, "database file (HDF5)")->required();
  command->add_option("--out", options->out, "forest file to write")->required();
  command->add_option("--trees", s.trees, "trees per mode")
      ->check(CLI::Range(1, 10000))
      ->capture_default_str();
  command->add_option("--depth", s.depth, "largest depth of a tree")
      ->check(CLI::Range(1, 20))
      ->capture_default_str();
  command->add_option("--features", options->features, "feature set")
      ->check(CLI::IsMember(sets))
      ->capture_default_str();
  command->add_option("--seed", s.seed, "of the bootstrap samples and of what is held out")
      ->capture_default_str();
  command
      ->add_option("--hold-out", options->hold_out, "share of the runs kept from training and evaluated on")
      ->check(CLI::Range(0.0, 0.9))
      ->capture_default_str();
}

}  // namespace

void add_forest(CLI::App& program, Invocation& invocation) {
  CLI::App* group = program.add_subcommand("forest", "Train and look at regression forests");
  allow_one_command(*group);
  const auto options = std::make_shared<ForestOptions>();
  add_train(*group, invocation, options);
  const auto add_file = [options](CLI::App* command) {
    command->add_option("FILE", options->file, "forest file")->required();
    return command;
  };
  add_file(add_command(*group, invocation, "info", "Settings, provenance and ranges of the training",
                       [options, &invocation] {
                         const RegressionForest forest = RegressionForest::load(options->file);
                         print(invocation.common.json ? json_text(forest) : forest_text(forest));
                       }));
  add_file(add_command(*group, invocation, "evaluate", "One-step accuracy beside the steady baseline",
                       [options, &invocation] {
                         const RegressionForest forest = RegressionForest::load(options->file);
                         const Evaluation e =
                             evaluate(forest, read_database(options->samples).training_samples());
                         print(invocation.common.json ? json_text(e) : evaluation_text(e));
                       }))
      ->add_option("--samples", options->samples, "database file (HDF5)")
      ->required();
  add_file(add_command(*group, invocation, "inspect", "Sizes of the trees and what they split on",
                       [options, &invocation] {
                         const ordered_json json = inspection(RegressionForest::load(options->file));
                         print(invocation.common.json ? json.dump() : inspection_text(json));
                       }));
}

}  // namespace conchoid
