// What the file of a forest holds behind its description (regressor_file.cpp): the trees of each mode (tree_bytes.hpp).
#include <nlohmann/json.hpp>

#include "conchoid/core/error.hpp"
#include "conchoid/learn/forest.hpp"
#include "conchoid/learn/regressor_kinds.hpp"
#include "conchoid/learn/tree_bytes.hpp"

namespace conchoid {
namespace {

using nlohmann::json;

}  // namespace

std::string RegressionForest::settings_json() const {
  return json{{"trees", settings_.trees},
              {"depth", settings_.depth},
              {"seed", settings_.seed},
              {"bins", settings_.bins},
              {"leaf", settings_.leaf}}
      .dump();
}

std::string RegressionForest::fit_json() const {
  json nodes = json::array();
  for (const TreeEnsemble& ensemble : ensembles_)
    nodes.push_back(ensemble.node_count());
  return json{{"nodes", nodes}}.dump();
}

std::string RegressionForest::summary() const {
  return "trees       " + std::to_string(settings_.trees) + " of depth " + std::to_string(settings_.depth) +
         " per mode";
}

void RegressionForest::write_fit(ByteWriter& out) const {
  for (const TreeEnsemble& ensemble : ensembles_)
    put_trees(out, ensemble);
}

std::unique_ptr<Regressor> RegressionForest::read(TrainingRecord record, const std::string& settings,
                                                  ByteReader& fit) {
  const json d = json::parse(settings);
  const ForestSettings s{d.at("trees"), d.at("depth"), record.features,
                         d.at("seed"),  d.at("bins"),  d.at("leaf")};
  auto forest = std::make_unique<RegressionForest>(RegressionForest(std::move(record), s));
  for (TreeEnsemble& ensemble : forest->ensembles_) {
    ensemble = get_trees(fit, static_cast<int>(forest->ranges().size()));
    if (ensemble.tree_count() != static_cast<std::size_t>(s.trees))
      throw InputError("the number of trees is wrong");
  }
  return forest;
}

RegressionForest RegressionForest::load(const std::filesystem::path& file) {
  const std::unique_ptr<Regressor> regressor = load_regressor(file);
  if (auto* forest = dynamic_cast<RegressionForest*>(regressor.get())) return std::move(*forest);
  throw InputError(file.string() + ": holds a " + std::string(regressor_kind(regressor->name()).title) +
                   ", not a regression forest; train one with `conchoid forest train --model forest`");
}

RegressorKind forest_kind() {
  const ForestSettings standard;
  RegressorKind kind;
  kind.name = "forest";
  kind.title = "regression forest";
  kind.magic = "CNCHFRST";
  kind.version = 2;
  kind.options = {{"trees", "trees per mode", standard.trees, 1, 10000, true},
                  {"depth", "largest depth of a tree", standard.depth, 1, 20, true},
                  {"leaf", "least number of samples in a leaf", standard.leaf, 1, 1e6, true}};
  kind.train = [](const SampleSet& samples, const TrainingSettings& wanted, Provenance provenance,
                  const TrainingProgress& progress) -> std::unique_ptr<Regressor> {
    const RegressorKind& own = regressor_kind("forest");
    ForestSettings settings;
    settings.trees = whole_option_value(own, wanted, "trees");
    settings.depth = whole_option_value(own, wanted, "depth");
    settings.leaf = whole_option_value(own, wanted, "leaf");
    settings.features = wanted.features;
    settings.seed = wanted.seed;
    return std::make_unique<RegressionForest>(
        RegressionForest::train(samples, settings, std::move(provenance), progress));
  };
  kind.read = &RegressionForest::read;
  return kind;
}

}  // namespace conchoid
