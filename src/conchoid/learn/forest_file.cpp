// What the file of a forest holds behind its description (regressor_file.cpp):
//   per mode: number of trees u32, per tree: number of nodes u32, feature u8[] (255: a leaf), threshold or, of a leaf,
//   value f32[]; nodes breadth first, children side by side
#include <nlohmann/json.hpp>

#include "conchoid/core/error.hpp"
#include "conchoid/learn/forest.hpp"
#include "conchoid/learn/regressor_kinds.hpp"

namespace conchoid {
namespace {

using nlohmann::json;

constexpr std::uint8_t leaf = 255;

// Breadth first, so that the children of inner nodes follow each other and need no index.
void put_trees(ByteWriter& out, const TreeEnsemble& ensemble) {
  const std::vector<RegressionTree> trees = ensemble.trees();
  out.put(static_cast<std::uint32_t>(trees.size()));
  for (const RegressionTree& tree : trees) {
    std::vector<std::uint8_t> feature(tree.size());
    std::vector<float> number(tree.size());
    for (std::size_t i = 0; i < tree.size(); ++i) {
      feature[i] = tree.left[i] < 0 ? leaf : static_cast<std::uint8_t>(tree.feature[i]);
      number[i] = tree.left[i] < 0 ? tree.value[i] : tree.threshold[i];
    }
    out.put(static_cast<std::uint32_t>(tree.size()));
    out.put_all(std::span<const std::uint8_t>(feature));
    out.put_all(std::span<const float>(number));
  }
}

TreeEnsemble get_trees(ByteReader& in, int features) {
  const auto count = in.get<std::uint32_t>();
  if (count > in.left()) throw OutOfBytes();
  std::vector<RegressionTree> trees(count);
  for (RegressionTree& tree : trees) {
    const auto nodes = in.get<std::uint32_t>();
    const auto feature = in.get_all<std::uint8_t>(nodes);
    const auto number = in.get_all<float>(nodes);
    std::int32_t next = 1;
    for (std::size_t i = 0; i < nodes; ++i) {
      const bool is_leaf = feature[i] == leaf;
      tree.feature.push_back(is_leaf ? -1 : feature[i]);
      tree.left.push_back(is_leaf ? -1 : next);
      tree.right.push_back(is_leaf ? -1 : next + 1);
      tree.threshold.push_back(is_leaf ? 0 : number[i]);
      tree.value.push_back(is_leaf ? number[i] : 0);
      next += is_leaf ? 0 : 2;
    }
  }
  return TreeEnsemble(trees, features);
}

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
    settings.trees = static_cast<int>(option_value(own, wanted, "trees").value());
    settings.depth = static_cast<int>(option_value(own, wanted, "depth").value());
    settings.leaf = static_cast<int>(option_value(own, wanted, "leaf").value());
    settings.features = wanted.features;
    settings.seed = wanted.seed;
    return std::make_unique<RegressionForest>(
        RegressionForest::train(samples, settings, std::move(provenance), progress));
  };
  kind.read = &RegressionForest::read;
  return kind;
}

}  // namespace conchoid
