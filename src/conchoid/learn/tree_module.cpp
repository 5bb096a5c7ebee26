// Trees by XGBoost: a module (core/module.hpp).
#include "conchoid/learn/tree_module.hpp"

#include <xgboost/c_api.h>

#include <cmath>
#include <mutex>
#include <nlohmann/json.hpp>
#include <string>
#include <string_view>

#include "conchoid/core/error.hpp"

namespace conchoid {
namespace {

void check(int status) {
  if (status != 0) throw ComputationError(std::string("training the trees failed: ") + XGBGetLastError());
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

struct TreeShape {
  int depth, leaf, bins;
  double rate = 1, penalty = 0;
};

Booster make_booster(const Matrix& matrix, const TreeShape& shape) {
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
  set("max_bin", std::to_string(shape.bins));
  set("max_depth", std::to_string(shape.depth));
  set("nthread", "1");
  set("base_score", "0");
  set("lambda", std::to_string(shape.penalty));
  set("alpha", "0");
  set("gamma", "0");
  set("min_child_weight", std::to_string(shape.leaf));
  set("eta", std::to_string(shape.rate));
  return booster;
}

/// One boosting round from zero: the tree of one bootstrap sample.
void grow_tree(const Booster& booster, const Matrix& matrix, const std::vector<float>& values,
               const std::vector<std::uint32_t>& counts) {
  const std::size_t n = counts.size();
  std::vector<float> gradient(n), hessian(n);
  for (std::size_t i = 0; i < n; ++i) {
    const auto count = static_cast<float>(counts[i]);
    gradient[i] = -count * values[i];
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

std::vector<RegressionTree> read_trees(const Booster& booster, std::size_t count) {
  bst_ulong length = 0;
  const char* bytes = nullptr;
  check(XGBoosterSaveModelToBuffer(booster.get(), R"({"format": "ubj"})", &length, &bytes));
  const nlohmann::json model = nlohmann::json::from_ubjson(std::string_view(bytes, length));
  const nlohmann::json& saved = model.at("learner").at("gradient_booster").at("model").at("trees");
  std::vector<RegressionTree> trees;
  for (std::size_t t = 0; t < count; ++t)
    trees.push_back(tree_from(saved.at(t)));
  return trees;
}

std::vector<float> own_prediction(const Booster& booster, const Matrix& matrix) {
  bst_ulong length = 0;
  const float* result = nullptr;
  check(XGBoosterPredict(booster.get(), matrix.get(), 0, 0, 0, &length, &result));
  return {result, result + length};
}

// The round after which what was left out was answered best; the last one where nothing was.
class BestRound {
 public:
  explicit BestRound(int patience) : patience_(patience) {}
  void see(int round, double error) {
    if (round > 0 && !(error < error_) && error > 0) return;
    error_ = error;
    round_ = round;
  }
  bool long_ago(int round) const { return round > round_ + patience_; }
  int round() const { return round_; }

 private:
  int patience_, round_ = 0;
  double error_ = 0;
};

class XgboostGrower : public TreeGrower {
 public:
  XgboostGrower(std::span<const float> rows, std::size_t columns, const BaggingSettings& settings)
      : matrices_(rows, columns), settings_(settings) {}

  RegressionTree grow(const std::vector<float>& values, const std::vector<std::uint32_t>& counts,
                      std::vector<float>* prediction) override {
    Matrix matrix = matrices_.take();
    RegressionTree tree;
    {
      const Booster booster = make_booster(matrix, {settings_.depth, settings_.leaf, settings_.bins});
      grow_tree(booster, matrix, values, counts);
      tree = read_trees(booster, 1).front();
      if (prediction) *prediction = own_prediction(booster, matrix);
    }
    matrices_.give(std::move(matrix));
    return tree;
  }

  std::vector<RegressionTree> boost(const std::vector<float>& values, const std::vector<char>& left_out,
                                    const BoostingSettings& settings) override {
    Matrix matrix = matrices_.take();
    std::vector<RegressionTree> trees;
    {
      const Booster booster = make_booster(
          matrix, {settings.depth, settings.leaf, settings.bins, settings.rate, settings.penalty});
      std::vector<float> gradient(values.size()), hessian(values.size());
      for (std::size_t i = 0; i < values.size(); ++i) {
        gradient[i] = left_out[i] ? 0 : -values[i];
        hessian[i] = left_out[i] ? 0 : 1;
      }
      BestRound best(settings.patience);
      for (int round = 0; round < settings.trees && !best.long_ago(round); ++round) {
        check(XGBoosterBoostOneIter(booster.get(), matrix.get(), gradient.data(), hessian.data(),
                                    values.size()));
        const std::vector<float> answer = own_prediction(booster, matrix);
        double error = 0;
        for (std::size_t i = 0; i < values.size(); ++i) {
          const float off = answer[i] - values[i];
          if (left_out[i])
            error += static_cast<double>(off) * static_cast<double>(off);
          else
            gradient[i] = off;
        }
        best.see(round, error);
      }
      trees = read_trees(booster, static_cast<std::size_t>(best.round() + 1));
    }
    matrices_.give(std::move(matrix));
    return trees;
  }

 private:
  MatrixPool matrices_;
  BaggingSettings settings_;
};

}  // namespace
}  // namespace conchoid

CONCHOID_MODULE_FUNCTION void conchoid_make_tree_grower(std::span<const float> rows, std::size_t columns,
                                                        const conchoid::BaggingSettings& settings,
                                                        std::unique_ptr<conchoid::TreeGrower>& grower) {
  static_assert(std::is_same_v<decltype(conchoid_make_tree_grower), conchoid::MakeTreeGrower>);
  grower = std::make_unique<conchoid::XgboostGrower>(rows, columns, settings);
}
