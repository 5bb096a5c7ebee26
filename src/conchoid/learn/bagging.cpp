#include "conchoid/learn/bagging.hpp"

#include <memory>
#include <mutex>

#include "conchoid/core/error.hpp"
#include "conchoid/core/parallel.hpp"
#include "conchoid/learn/tree_module.hpp"

namespace conchoid {
namespace {

/// Mean over the trees of every target.
std::vector<std::vector<float>> mean_predictions(const std::vector<std::vector<float>>& single,
                                                 std::size_t targets, std::size_t trees) {
  std::vector<std::vector<float>> means;
  for (std::size_t m = 0; m < targets; ++m) {
    std::vector<double> sum(single[m * trees].size(), 0.0);
    for (std::size_t t = 0; t < trees; ++t)
      for (std::size_t i = 0; i < sum.size(); ++i)
        sum[i] += static_cast<double>(single[m * trees + t][i]);
    means.emplace_back();
    for (const double s : sum)
      means.back().push_back(static_cast<float>(s / static_cast<double>(trees)));
  }
  return means;
}

void check_settings(const BaggingSettings& s) {
  if (s.trees < 1) throw InputError("a forest needs at least one tree; give a positive number of trees");
  if (s.depth < 1 || s.depth > 20) throw InputError("the depth of the trees must lie between 1 and 20");
  if (s.leaf < 1) throw InputError("a leaf needs at least one sample; give a positive number");
  if (s.bins < 2 || s.bins > 65536) throw InputError("the number of bins must lie between 2 and 65536");
}

}  // namespace

std::vector<std::vector<RegressionTree>> fit_bagged_trees(std::span<const float> rows, std::size_t columns,
                                                          const std::vector<BaggingTarget>& targets,
                                                          const BaggingSettings& settings,
                                                          const std::function<void()>& progress,
                                                          std::vector<std::vector<float>>* predictions) {
  check_settings(settings);
  const std::size_t n = rows.size() / columns;
  if (n == 0)
    throw InputError("there are no samples to learn from; generate a database with runs that crack");
  const auto per_target = static_cast<std::size_t>(settings.trees);
  std::vector<std::vector<RegressionTree>> result(targets.size(), std::vector<RegressionTree>(per_target));
  std::vector<std::vector<float>> single(predictions ? targets.size() * per_target : 0);
  std::unique_ptr<TreeGrower> grower;
  module_function<MakeTreeGrower>(kTreeModule, "conchoid_make_tree_grower", "training a forest")(
      rows, columns, settings, grower);
  std::mutex progress_mutex;
  parallel_for(targets.size() * per_target, 1, [&](std::size_t begin, std::size_t end) {
    for (std::size_t job = begin; job < end; ++job) {
      const std::size_t m = job / per_target, t = job % per_target;
      result[m][t] = grower->grow(targets[m].values,
                                  bootstrap_counts(n, stream_seed(settings.seed, targets[m].stream, t)),
                                  predictions ? &single[job] : nullptr);
      const std::lock_guard lock(progress_mutex);
      if (progress) progress();
    }
  });
  if (predictions) *predictions = mean_predictions(single, targets.size(), per_target);
  return result;
}

}  // namespace conchoid
