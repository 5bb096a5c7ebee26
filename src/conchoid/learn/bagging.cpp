#include "conchoid/learn/bagging.hpp"

#include <xgboost/c_api.h>

#include <cmath>
#include <memory>
#include <mutex>
#include <nlohmann/json.hpp>
#include <string>
#include <string_view>

#include "conchoid/core/error.hpp"
#include "conchoid/core/parallel.hpp"

namespace conchoid {
namespace {

void check(int status) {
  if (status != 0) throw ComputationError(std::string("training the forest failed: ") + XGBGetLastError());
}

struct FreeMatrix {
  void operator()(void* handle) const { XGDMatrixFree(handle); }
};
struct FreeBooster {
  void operator()(void* handle) const { XGBoosterFree(handle); }
};
using Matrix = std::unique_ptr<void, FreeMatrix>;
using Booster = std::unique_ptr<void, FreeBooster>;

Matrix make_matrix(std::span<const float> rows, std::size_t columns) {
  DMatrixHandle handle = nullptr;
  check(XGDMatrixCreateFromMat_omp(rows.data(), rows.size() / columns, columns, std::nanf(""), &handle, 1));
  return Matrix(handle);
}

/// Matrices in use by no worker. XGBoost keeps its quantile index inside the matrix, so a worker reuses one
/// but never shares it.
class MatrixPool {
 public:
  MatrixPool(std::span<const float> rows, std::size_t columns) : rows_(rows), columns_(columns) {}
  Matrix take() {
    {
      const std::lock_guard lock(mutex_);
      if (!idle_.empty()) {
        Matrix matrix = std::move(idle_.back());
        idle_.pop_back();
        return matrix;
      }
    }
    return make_matrix(rows_, columns_);
  }
  void give(Matrix matrix) {
    const std::lock_guard lock(mutex_);
    idle_.push_back(std::move(matrix));
  }

 private:
  std::span<const float> rows_;
  std::size_t columns_;
  std::mutex mutex_;
  std::vector<Matrix> idle_;
};

Booster make_booster(const Matrix& matrix, const BaggingSettings& settings) {
  const DMatrixHandle data[] = {matrix.get()};
  BoosterHandle handle = nullptr;
  check(XGBoosterCreate(data, 1, &handle));
  Booster booster(handle);
  const auto set = [&](const char* key, const std::string& value) {
    check(XGBoosterSetParam(booster.get(), key, value.c_str()));
  };
  set("verbosity", "0");
  set("objective", "reg:squarederror");
  set("tree_method", "hist");
  set("max_bin", std::to_string(settings.bins));
  set("max_depth", std::to_string(settings.depth));
  set("nthread", "1");
  set("base_score", "0");
  set("lambda", "0");
  set("alpha", "0");
  set("gamma", "0");
  set("min_child_weight", "1");
  set("eta", "1");
  return booster;
}

/// One boosting round from zero: the tree of one bootstrap sample.
void grow_tree(const Booster& booster, const Matrix& matrix, const BaggingTarget& target,
               const std::vector<std::uint32_t>& counts) {
  const std::size_t n = counts.size();
  std::vector<float> gradient(n), hessian(n);
  for (std::size_t i = 0; i < n; ++i) {
    const auto count = static_cast<float>(counts[i]);
    gradient[i] = -count * target.values[i];
    hessian[i] = count;
  }
  check(XGBoosterBoostOneIter(booster.get(), matrix.get(), gradient.data(), hessian.data(), n));
}

RegressionTree tree_from(const nlohmann::json& saved) {
  RegressionTree tree;
  tree.left = saved.at("left_children").get<std::vector<std::int32_t>>();
  tree.right = saved.at("right_children").get<std::vector<std::int32_t>>();
  tree.feature = saved.at("split_indices").get<std::vector<std::int32_t>>();
  tree.threshold = saved.at("split_conditions").get<std::vector<float>>();
  tree.value = tree.threshold;  // XGBoost keeps both in one array
  for (std::size_t i = 0; i < tree.size(); ++i)
    (tree.left[i] < 0 ? tree.threshold[i] : tree.value[i]) = 0;
  return tree;
}

RegressionTree read_tree(const Booster& booster) {
  bst_ulong length = 0;
  const char* bytes = nullptr;
  check(XGBoosterSaveModelToBuffer(booster.get(), R"({"format": "ubj"})", &length, &bytes));
  const nlohmann::json model = nlohmann::json::from_ubjson(std::string_view(bytes, length));
  return tree_from(model.at("learner").at("gradient_booster").at("model").at("trees").at(0));
}

std::vector<float> own_prediction(const Booster& booster, const Matrix& matrix) {
  bst_ulong length = 0;
  const float* result = nullptr;
  check(XGBoosterPredict(booster.get(), matrix.get(), 0, 0, 0, &length, &result));
  return {result, result + length};
}

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
  MatrixPool matrices(rows, columns);
  std::mutex progress_mutex;
  parallel_for(targets.size() * per_target, 1, [&](std::size_t begin, std::size_t end) {
    for (std::size_t job = begin; job < end; ++job) {
      const std::size_t m = job / per_target, t = job % per_target;
      Matrix matrix = matrices.take();
      {
        const Booster booster = make_booster(matrix, settings);
        grow_tree(booster, matrix, targets[m],
                  bootstrap_counts(n, stream_seed(settings.seed, targets[m].stream, t)));
        result[m][t] = read_tree(booster);
        if (predictions) single[job] = own_prediction(booster, matrix);
      }
      matrices.give(std::move(matrix));
      const std::lock_guard lock(progress_mutex);
      if (progress) progress();
    }
  });
  if (predictions) *predictions = mean_predictions(single, targets.size(), per_target);
  return result;
}

}  // namespace conchoid
