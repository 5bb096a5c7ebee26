#include <cmath>
#include <numeric>
#include <optional>

#include "conchoid/learn/forest.hpp"
#include "conchoid/learn/regressor_kinds.hpp"
#include "learn/synthetic.hpp"
#include "side_by_side.hpp"

namespace conchoid::bench {
namespace {

// Runs of 10 frame pairs and 10 front nodes: 100 samples each.
SampleSet made_up(int runs) {
  SampleSet set;
  for (int run = 0; run < runs; ++run)
    set.append(test::synthetic_run(run, 11, 10, 1.1, 0.5));
  return set;
}

SampleSet ten_thousand() {
  return made_up(100);
}

// Rows one by one and node by node, as the definition of a tree says.
double walk(const RegressionTree& tree, const float* row) {
  std::int32_t i = 0;
  while (tree.left[static_cast<std::size_t>(i)] >= 0) {
    const auto k = static_cast<std::size_t>(i);
    i = row[tree.feature[k]] < tree.threshold[k] ? tree.left[k] : tree.right[k];
  }
  return tree.value[static_cast<std::size_t>(i)];
}

/// Share of the labels' variance that the forest leaves unexplained, mode I.
double unexplained(const RegressionForest& forest, const SampleSet& samples) {
  double residual = 0, sum = 0, square = 0;
  const auto predicted = forest.predict_openings(samples);
  for (std::size_t i = 0; i < samples.size(); ++i) {
    const double u = samples[i].opening[0];
    residual += (predicted[i].opening[0] - u) * (predicted[i].opening[0] - u);
    sum += u;
    square += u * u;
  }
  return residual / (square - sum * sum / static_cast<double>(samples.size()));
}

// Three forests of 50 trees of depth 10; beside it 5 trees each (ratio: ideally 0.1).
void training(benchmark::State& state) {
  const SampleSet samples = ten_thousand();
  double left = 0;
  const auto train = [&](int trees, double* unexplained_share) {
    ForestSettings settings;
    settings.trees = trees;
    std::optional<RegressionForest> forest;
    const double time = seconds([&] { forest = RegressionForest::train(samples, settings); });
    if (unexplained_share) *unexplained_share = unexplained(*forest, samples);
    return time;
  };
  const Times t = side_by_side(
      state, [&] { return train(50, &left); }, [&] { return train(5, nullptr); });
  state.counters["samples"] = static_cast<double>(samples.size());
  state.counters["ms_per_tree"] = 1e3 * t.fast / 150;
  state.counters["unexplained"] = left;
}

// Three forests of so many trees of such a depth of a million samples; beside it of a tenth of them (ratio: ideally 0.1).
void training_on_a_million(benchmark::State& state) {
  const SampleSet samples = made_up(10000);
  std::vector<std::size_t> first(samples.size() / 10);
  std::iota(first.begin(), first.end(), std::size_t{0});
  const SampleSet tenth = samples.subset(first);
  ForestSettings settings;
  settings.trees = static_cast<int>(state.range(0));
  settings.depth = static_cast<int>(state.range(1));
  const auto train = [&](const SampleSet& on) {
    return seconds([&] { benchmark::DoNotOptimize(RegressionForest::train(on, settings)); });
  };
  side_by_side(
      state, [&] { return train(samples); }, [&] { return train(tenth); });
}

// One forest of 50 trees of depth 10, evaluated side by side for many rows against walking row by row.
void prediction(benchmark::State& state) {
  const SampleSet samples = ten_thousand();
  ForestSettings settings;
  const RegressionForest forest = RegressionForest::train(samples, settings);
  const TreeEnsemble& ensemble = forest.ensemble(0);
  const std::vector<RegressionTree> trees = ensemble.trees();
  const auto rows = static_cast<std::size_t>(state.range(0));
  const FeatureMatrix matrix = feature_matrix(samples, settings.features);
  const std::vector<float> values(matrix.values.begin(),
                                  matrix.values.begin() + static_cast<std::ptrdiff_t>(rows * matrix.columns));
  std::vector<TreeEnsemble::Answer> fast(rows);
  std::vector<double> slow(rows);
  const Times t = side_by_side(
      state, [&] { return seconds([&] { ensemble.evaluate(values, fast); }); },
      [&] {
        return seconds([&] {
          for (std::size_t r = 0; r < rows; ++r) {
            double sum = 0;
            for (const RegressionTree& tree : trees)
              sum += walk(tree, values.data() + r * matrix.columns);
            slow[r] = sum / static_cast<double>(trees.size());
          }
        });
      });
  for (std::size_t r = 0; r < rows; ++r)
    if (fast[r].mean != slow[r]) return state.SkipWithError("evaluation and oracle disagree");
  state.counters["us_per_row"] = 1e6 * t.fast / static_cast<double>(rows);
}

// Openings of 1,000 front points by a kind of regressor with its standard settings, beside a forest.
void kinds(benchmark::State& state) {
  const SampleSet samples = ten_thousand();
  std::vector<std::size_t> some(1000);
  std::iota(some.begin(), some.end(), std::size_t{0});
  const SampleSet asked = samples.subset(some);
  const RegressorKind& kind = regressor_kinds().at(static_cast<std::size_t>(state.range(0)));
  TrainingSettings settings;
  settings.features = FeatureSet::dimensionless;
  const auto of_kind = train_regressor(kind, samples, settings);
  const RegressionForest forest = RegressionForest::train(samples, {.features = FeatureSet::dimensionless});
  const auto asking = [&](const Regressor& regressor) {
    return [&] { return seconds([&] { benchmark::DoNotOptimize(regressor.predict_openings(asked)); }); };
  };
  const Times t = side_by_side(state, asking(*of_kind), asking(forest));
  state.SetLabel(std::string(kind.name));
  state.counters["us_per_point"] = 1e6 * t.fast / static_cast<double>(some.size());
}

}  // namespace

BENCHMARK(kinds)->DenseRange(0, 3)->Iterations(5)->UseManualTime()->Unit(benchmark::kMillisecond);
BENCHMARK(training)->Iterations(1)->UseManualTime()->Unit(benchmark::kMillisecond);
BENCHMARK(training_on_a_million)
    ->Args({50, 10})
    ->Args({25, 15})
    ->Iterations(1)
    ->UseManualTime()
    ->Unit(benchmark::kSecond);
BENCHMARK(prediction)->Arg(100)->Arg(10000)->Iterations(20)->UseManualTime()->Unit(benchmark::kMillisecond);

}  // namespace conchoid::bench
