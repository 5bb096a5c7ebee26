#include "conchoid/learn/forest.hpp"

#include "conchoid/learn/bagging.hpp"
#include "conchoid/learn/single_rows.hpp"
#include "conchoid/learn/training.hpp"

namespace conchoid {

RegressionForest RegressionForest::train(const SampleSet& samples, const ForestSettings& settings,
                                         Provenance provenance, const Progress& progress) {
  TrainingData data = prepare_training(samples, settings.features, std::move(provenance));
  std::vector<BaggingTarget> targets(3);
  for (std::size_t mode = 0; mode < 3; ++mode)
    targets[mode] = {single_rows(data.labels[mode]), mode};
  int done = 0;
  const auto step = [&] {
    if (progress) progress(++done, 3 * settings.trees);
  };
  const auto trees =
      fit_bagged_trees(single_rows(data.rows.values), data.rows.columns, targets,
                       {settings.trees, settings.depth, settings.seed, settings.bins, settings.leaf}, step);
  RegressionForest forest(std::move(data.record), settings);
  for (std::size_t mode = 0; mode < 3; ++mode)
    forest.ensembles_[mode] = TreeEnsemble(trees[mode], static_cast<int>(data.rows.columns));
  return forest;
}

void RegressionForest::predict_standardised(const FeatureMatrix& matrix, std::size_t begin, std::size_t end,
                                            std::span<Prediction> out) const {
  const std::vector<float> rows = single_rows(matrix, begin, end);
  std::vector<TreeEnsemble::Answer> answers(end - begin);
  for (int mode = 0; mode < 3; ++mode) {
    ensemble(mode).evaluate(rows, answers);
    for (std::size_t i = 0; i < answers.size(); ++i) {
      out[i].mean[mode] = answers[i].mean;
      out[i].spread[mode] = answers[i].spread;
    }
  }
}

}  // namespace conchoid
