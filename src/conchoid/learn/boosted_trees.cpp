// What the file of boosted trees holds behind its description (regressor_file.cpp): per mode the number of members u32,
// and each one's trees (tree_bytes.hpp).
#include "conchoid/learn/boosted_trees.hpp"

#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "conchoid/core/error.hpp"
#include "conchoid/learn/members.hpp"
#include "conchoid/learn/regressor_kinds.hpp"
#include "conchoid/learn/single_rows.hpp"
#include "conchoid/learn/training.hpp"
#include "conchoid/learn/tree_bytes.hpp"

namespace conchoid {
namespace {

using nlohmann::json;

}  // namespace

BoostedTrees BoostedTrees::train(const SampleSet& samples, FeatureSet features,
                                 const BoostingSettings& settings, Provenance provenance,
                                 const TrainingProgress& progress) {
  TrainingData data = prepare_training(samples, features, std::move(provenance));
  std::vector<std::vector<float>> targets;
  for (const std::vector<double>& labels : data.labels)
    targets.push_back(single_rows(labels));
  const RunGroups groups = run_groups(data.run, kMembers);
  int done = 0;
  const auto step = [&] {
    if (progress) progress(++done, 3 * groups.count);
  };
  const auto fitted =
      fit_boosted_trees(single_rows(data.rows.values), data.rows.columns, targets, groups, settings, step);
  BoostedTrees result(std::move(data.record), settings);
  for (std::size_t mode = 0; mode < 3; ++mode)
    for (const BoostedMember& member : fitted[mode])
      result.members_[mode].emplace_back(member, static_cast<int>(data.rows.columns));
  return result;
}

void BoostedTrees::predict_standardised(const FeatureMatrix& matrix, std::size_t begin, std::size_t end,
                                        std::span<Prediction> out) const {
  const std::vector<float> rows = single_rows(matrix, begin, end);
  std::vector<TreeEnsemble::Answer> answers(end - begin);
  for (int mode = 0; mode < 3; ++mode) {
    std::vector<MemberAnswers> of_members(answers.size());
    for (const TreeEnsemble& member : members(mode)) {
      member.evaluate(rows, answers);
      for (std::size_t i = 0; i < answers.size(); ++i)
        of_members[i].add(answers[i].mean * static_cast<double>(member.tree_count()));
    }
    for (std::size_t i = 0; i < answers.size(); ++i) {
      out[i].mean[mode] = of_members[i].mean();
      out[i].spread[mode] = of_members[i].spread();
    }
  }
}

std::string BoostedTrees::settings_json() const {
  return json{{"trees", settings_.trees},      {"depth", settings_.depth},     {"rate", settings_.rate},
              {"leaf", settings_.leaf},        {"penalty", settings_.penalty}, {"bins", settings_.bins},
              {"patience", settings_.patience}}
      .dump();
}

std::string BoostedTrees::fit_json() const {
  json trees = json::array(), nodes = json::array();
  for (const std::vector<TreeEnsemble>& mode : members_) {
    std::size_t all_trees = 0, all_nodes = 0;
    for (const TreeEnsemble& member : mode) {
      all_trees += member.tree_count();
      all_nodes += member.node_count();
    }
    trees.push_back(all_trees);
    nodes.push_back(all_nodes);
  }
  return json{{"trees_of_members", trees}, {"nodes", nodes}}.dump();
}

std::string BoostedTrees::summary() const {
  std::string text;
  for (const std::vector<TreeEnsemble>& mode : members_) {
    std::vector<std::size_t> trees;
    for (const TreeEnsemble& member : mode)
      trees.push_back(member.tree_count());
    text += fmt::format("{}{}", text.empty() ? "" : " / ", fmt::join(trees, ", "));
  }
  return fmt::format("trees       {} of depth {} by members, modes I / II / III", text, settings_.depth);
}

void BoostedTrees::write_fit(ByteWriter& out) const {
  for (const std::vector<TreeEnsemble>& mode : members_) {
    out.put(static_cast<std::uint32_t>(mode.size()));
    for (const TreeEnsemble& member : mode)
      put_trees(out, member);
  }
}

std::unique_ptr<Regressor> BoostedTrees::read(TrainingRecord record, const std::string& settings,
                                              ByteReader& fit) {
  const json d = json::parse(settings);
  const BoostingSettings s{d.at("trees"),   d.at("depth"), d.at("rate"),    d.at("leaf"),
                           d.at("penalty"), d.at("bins"),  d.at("patience")};
  auto result = std::make_unique<BoostedTrees>(BoostedTrees(std::move(record), s));
  for (std::vector<TreeEnsemble>& mode : result->members_) {
    const auto count = fit.get<std::uint32_t>();
    if (count != 1 && count != kMembers) throw InputError("the number of members is wrong");
    for (std::uint32_t i = 0; i < count; ++i) {
      mode.push_back(get_trees(fit, static_cast<int>(result->ranges().size())));
      if (mode.back().tree_count() == 0) throw InputError("a member has no trees");
    }
  }
  return result;
}

RegressorKind boosted_kind() {
  const BoostingSettings standard;
  RegressorKind kind;
  kind.name = "boosted";
  kind.title = "set of boosted trees";
  kind.magic = "CNCHBOOS";
  kind.options = {{"trees", "trees per mode and member, at most", standard.trees, 1, 10000, true},
                  {"depth", "largest depth of a tree", standard.depth, 1, 20, true},
                  {"rate", "share of its answer that a tree gives", standard.rate, 1e-3, 1, false},
                  {"leaf", "least number of samples in a leaf", standard.leaf, 1, 1e6, true}};
  kind.train = [](const SampleSet& samples, const TrainingSettings& wanted, Provenance provenance,
                  const TrainingProgress& progress) -> std::unique_ptr<Regressor> {
    const RegressorKind& own = regressor_kind("boosted");
    BoostingSettings settings;
    settings.trees = whole_option_value(own, wanted, "trees");
    settings.depth = whole_option_value(own, wanted, "depth");
    settings.rate = option_value(own, wanted, "rate").value();
    settings.leaf = whole_option_value(own, wanted, "leaf");
    return std::make_unique<BoostedTrees>(
        BoostedTrees::train(samples, wanted.features, settings, std::move(provenance), progress));
  };
  kind.read = &BoostedTrees::read;
  return kind;
}

}  // namespace conchoid
