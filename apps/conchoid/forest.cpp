#include "conchoid/learn/forest.hpp"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <map>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>

#include "command.hpp"
#include "conchoid/core/error.hpp"
#include "conchoid/core/interrupt.hpp"
#include "conchoid/core/log.hpp"
#include "conchoid/core/progress.hpp"
#include "conchoid/learn/database_provenance.hpp"
#include "conchoid/learn/evaluate.hpp"
#include "conchoid/learn/regressor_kinds.hpp"
#include "conchoid/learn/shipped.hpp"
#include "conchoid/learn/summary.hpp"
#include "conchoid/sim/methods.hpp"
#include "evaluation_text.hpp"

namespace conchoid {
namespace {

using nlohmann::ordered_json;

struct ForestOptions {
  std::vector<std::string> samples;
  std::string file, out, model = "forest", features = "paper-4";
  TrainingSettings settings;
  std::map<std::string, double> numbers;  ///< of all kinds, by name; given ones become settings.options
  std::map<std::string, CLI::Option*> given;
  double hold_out = 0;
  TrainingChoice choice;
  std::vector<std::string> hidden;
  bool no_end_game = false;
};

void require_classes(const std::vector<Database>& databases, const std::set<std::string>& classes) {
  std::set<std::string> known;
  for (const Database& database : databases)
    known.merge(database.body_classes());
  for (const std::string& name : classes)
    if (!known.contains(name))
      throw InputError(fmt::format("there are no bodies of the class \"{}\" in the samples; choose from {}",
                                   name, fmt::join(known, ", ")));
}

// By mode what was stated and what was found: "I 0.013 → 0.038, …".
std::string calibration_text(const Regressor& regressor) {
  std::string text;
  for (std::size_t mode = 0; mode < 3; ++mode) {
    std::vector<std::string> knots;
    for (const SpreadCalibration::Knot& knot : regressor.record().calibration[mode].knots())
      knots.push_back(fmt::format("{:.3g} → {:.3g}", knot.stated, knot.found));
    text += fmt::format("\n  {:<3} {}", kModes[mode], fmt::join(knots, ", "));
  }
  return text;
}

std::string regressor_text(const Regressor& regressor) {
  const Provenance& p = regressor.provenance();
  std::string text = fmt::format("model       {}\nfeatures    {}\n{}\ntrained on  {} samples of {} runs ({})",
                                 regressor_kind(regressor.name()).title, name(regressor.feature_set()),
                                 regressor.summary(), p.samples, p.runs, fmt::join(p.models, ", "));
  if (!p.hidden_features.empty()) text += fmt::format("\nhidden      {}", fmt::join(p.hidden_features, ", "));
  text += regressor.calibrated()
              ? "\nspread, stated → found on runs that it has not seen" + calibration_text(regressor)
              : "\nspread      as stated (not calibrated)";
  const std::vector<std::string> names = feature_names(regressor.feature_set());
  for (std::size_t i = 0; i < names.size(); ++i)
    text += fmt::format("\n  {:<28} {:12.4e} … {:12.4e}", names[i], regressor.ranges()[i].minimum,
                        regressor.ranges()[i].maximum);
  return text;
}

// Of the databases that are named, the samples of the classes that are, as the feature set learns from them.
JoinedSamples chosen_samples(const ForestOptions& options, FeatureSet features, std::string_view use) {
  std::vector<Database> databases;
  for (const std::string& file : options.samples) {
    databases.push_back(read_database(file));
    if (!databases.back().complete())
      warning(fmt::format("{}: some planned runs are missing; the {} goes by what is there", file, use));
  }
  TrainingChoice choice = options.choice;
  choice.end_game = learns_all_samples(features) && !options.no_end_game;
  choice.new_nodes = learns_all_samples(features);
  for (const auto* classes : {&choice.only, &choice.without})
    require_classes(databases, *classes);
  return join_samples(databases, choice);
}

void train(ForestOptions options, const CommonOptions& common) {
  options.settings.features = feature_set_from_name(options.features);
  for (const auto& [name, option] : options.given)
    if (option->count() > 0) options.settings.options[name] = options.numbers[name];
  std::vector<std::string> hidden = named_features(options.settings.features, options.hidden);
  JoinedSamples joined = chosen_samples(options, options.settings.features, "training");
  joined.provenance.hidden_features = std::move(hidden);
  Split split{std::move(joined.samples), {}};
  if (options.hold_out > 0) split = split_by_run(split.training, options.hold_out, options.settings.seed);

  std::optional<Progress> progress;
  const auto on_step = [&progress](int, int total) {
    throw_if_interrupted();
    if (!progress) progress.emplace("training", static_cast<std::size_t>(total));
    progress->advance();
  };
  const std::unique_ptr<Regressor> model = train_regressor(
      regressor_kind(options.model), split.training, options.settings, std::move(joined.provenance), on_step);
  progress.reset();
  model->save(options.out);

  if (split.held_out.empty()) return print(common.json ? json_text(*model) : regressor_text(*model));
  const Evaluation held_out = evaluate(*model, split.held_out, baseline_predictors());
  if (!common.json) return print(regressor_text(*model) + "\n\nheld out: " + one_step_text(held_out));
  ordered_json json = ordered_json::parse(json_text(*model));
  json["held_out"] = ordered_json::parse(json_text(held_out));
  print(json.dump());
}

void calibrate(const ForestOptions& options, const CommonOptions& common) {
  const std::unique_ptr<Regressor> model = load_regressor(database_file(options.file));
  model->calibrate(chosen_samples(options, model->feature_set(), "calibration").samples);
  model->save(options.out);
  print(common.json ? json_text(*model) : regressor_text(*model));
}

/// Numbers that kinds of regressors can be given; one that several kinds know stands once, and each kind looks at its own
/// range.
void add_training_options(CLI::App& command, ForestOptions& options) {
  struct Known {
    std::string help;
    double minimum, maximum;
    bool whole;
  };
  std::map<std::string, Known> known;
  for (const RegressorKind& kind : regressor_kinds())
    for (const TrainingOption& option : kind.options) {
      const auto [at, is_new] = known.try_emplace(std::string(option.name),
                                                  Known{"", option.minimum, option.maximum, option.whole});
      Known& k = at->second;
      k.minimum = std::min(k.minimum, option.minimum);
      k.maximum = std::max(k.maximum, option.maximum);
      k.help += fmt::format("{}{}: {}{}", is_new ? "" : "; ", kind.name, option.help,
                            option.standard ? fmt::format(" [{}]", *option.standard) : "");
    }
  for (const auto& [name, k] : known)
    options.given[name] =
        command.add_option("--" + name, options.numbers[name], k.help)
            ->check(k.whole ? CLI::Range(static_cast<int>(k.minimum), static_cast<int>(k.maximum))
                            : CLI::Range(k.minimum, k.maximum))
            ->type_name(k.whole ? "INT" : "FLOAT");
}

void add_class_choice(CLI::App& command, ForestOptions& options) {
  command
      .add_option("--only", options.choice.only,
                  "classes of bodies to go by, with commas between; without it all")
      ->delimiter(',');
  command.add_option("--without", options.choice.without, "classes of bodies to leave out, likewise")
      ->delimiter(',');
}

void add_train(CLI::App& group, Invocation& invocation, const std::shared_ptr<ForestOptions>& options) {
  CLI::App* command = add_command(group, invocation, "train", "Train a regressor for all three modes",
                                  [options, &invocation] { train(*options, invocation.common); });
  std::vector<std::string> sets, models;
  for (FeatureSet set : all_feature_sets())
    sets.emplace_back(name(set));
  for (const RegressorKind& kind : regressor_kinds())
    models.emplace_back(kind.name);
  command->add_option("SAMPLES", options->samples, "database files (HDF5)")->required()->expected(1, 1000);
  command->add_option("--out", options->out, "file to write")->required();
  command->add_option("--model", options->model, "kind of regressor")
      ->check(CLI::IsMember(models))
      ->capture_default_str();
  add_training_options(*command, *options);
  command->add_option("--features", options->features, "feature set")
      ->check(CLI::IsMember(sets))
      ->capture_default_str();
  command
      ->add_option("--seed", options->settings.seed,
                   "of whatever is drawn at random, what is held out among it")
      ->capture_default_str();
  command
      ->add_option("--hold-out", options->hold_out, "share of the runs kept from training and evaluated on")
      ->check(CLI::Range(0.0, 0.9))
      ->capture_default_str();
  add_class_choice(*command, *options);
  command
      ->add_option("--hide", options->hidden,
                   "features not to look at, with commas between; traction* are all that begin so")
      ->delimiter(',');
  command->add_flag("--no-end-game", options->no_end_game,
                    "leave out openings above 3 r̄, as all sets but versatile do");
}

void add_calibrate(CLI::App& group, Invocation& invocation, const std::shared_ptr<ForestOptions>& options) {
  CLI::App* command =
      add_command(group, invocation, "calibrate",
                  "Find what the spread of a regressor is worth, on runs that it has not seen",
                  [options, &invocation] { calibrate(*options, invocation.common); });
  add_regressor_argument(*command, options->file);
  command->add_option("SAMPLES", options->samples, "database files (HDF5) of such runs")
      ->required()
      ->expected(1, 1000);
  command->add_option("--out", options->out, "file to write: the same regressor, calibrated")->required();
  add_class_choice(*command, *options);
}

}  // namespace

void add_forest(CLI::App& program, Invocation& invocation) {
  CLI::App* group = program.add_subcommand("forest", "Train regressors on databases and look at them");
  allow_one_command(*group);
  const auto options = std::make_shared<ForestOptions>();
  add_train(*group, invocation, options);
  add_calibrate(*group, invocation, options);
  CLI::App* info = add_command(
      *group, invocation, "info", "Settings, provenance and ranges of the training", [options, &invocation] {
        const std::unique_ptr<Regressor> model = load_regressor(database_file(options->file));
        print(invocation.common.json ? json_text(*model) : regressor_text(*model));
      });
  add_regressor_argument(*info, options->file);
  add_forest_evaluate(*group, invocation);
  add_forest_inspect(*group, invocation);
}

}  // namespace conchoid
