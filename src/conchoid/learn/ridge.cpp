// What the file of a ridge regression holds behind its description (regressor_file.cpp), all f64:
//   means and 1/deviations of features and of terms (term_basis.cpp) · per mode: β of every term ·
//   L row after row up to the diagonal · residual deviation per mode
#include "conchoid/learn/ridge.hpp"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <sstream>

#include "conchoid/core/error.hpp"
#include "conchoid/learn/regressor_kinds.hpp"
#include "conchoid/learn/ridge_fit.hpp"
#include "conchoid/learn/training.hpp"

namespace conchoid {
namespace {

using nlohmann::json;

constexpr double kSmallestLambda = 1e-12, kLargestLambda = 1e6;

/// zᵀA⁻¹z by forward substitution with L.
double leverage(const std::vector<double>& factor, std::span<const double> z, std::vector<double>& v) {
  double sum = 0;
  const double* row = factor.data();
  for (std::size_t i = 0; i < z.size(); ++i) {
    double x = z[i];
    for (std::size_t k = 0; k < i; ++k)
      x -= row[k] * v[k];
    v[i] = x / row[i];
    sum += v[i] * v[i];
    row += i + 1;
  }
  return sum;
}

}  // namespace

RidgeRegression RidgeRegression::train(const SampleSet& samples, const RidgeSettings& settings,
                                       Provenance provenance) {
  if (settings.degree != 1 && settings.degree != 2)
    throw InputError("the degree of a ridge regression must be 1 or 2");
  if (settings.lambda && !(*settings.lambda >= kSmallestLambda && *settings.lambda <= kLargestLambda))
    throw InputError("lambda of a ridge regression must lie between 1e-12 and 1e6");
  const TrainingData data = prepare_training(samples, settings.features, std::move(provenance));
  RidgeRegression ridge(data.record);
  ridge.basis_ = TermBasis(data.rows, settings.degree);
  ridge.lambda_ = settings.lambda ? *settings.lambda : choose_lambda(data, ridge.basis_, data.run);
  const RidgeFit fit = fit_ridge(data, ridge.basis_, ridge.lambda_);
  for (int mode = 0; mode < 3; ++mode)
    ridge.beta_[static_cast<std::size_t>(mode)].assign(fit.beta.col(mode).begin(), fit.beta.col(mode).end());
  for (Eigen::Index i = 0; i < fit.factor.rows(); ++i)
    for (Eigen::Index k = 0; k <= i; ++k)
      ridge.factor_.push_back(fit.factor(i, k));
  ridge.residual_ = fit.residual;
  return ridge;
}

void RidgeRegression::predict_standardised(const FeatureMatrix& rows, std::size_t begin, std::size_t end,
                                           std::span<Prediction> out) const {
  const double n = static_cast<double>(provenance().samples);
  std::vector<double> z(basis_.size()), v(basis_.size());
  for (std::size_t i = begin; i < end; ++i) {
    basis_.evaluate(rows.row(i), z);
    Prediction& p = out[i - begin];
    for (int mode = 0; mode < 3; ++mode) {
      const std::vector<double>& beta = beta_[static_cast<std::size_t>(mode)];
      double sum = 0;
      for (std::size_t k = 0; k < z.size(); ++k)
        sum += beta[k] * z[k];
      p.mean[mode] = sum;
    }
    p.spread = residual_ * std::sqrt(1 + (1 + leverage(factor_, z, v)) / n);
  }
}

std::string RidgeRegression::settings_json() const {
  return json{{"degree", basis_.degree()}, {"lambda", lambda_}}.dump();
}

std::string RidgeRegression::fit_json() const {
  return json{{"terms", basis_.size()},
              {"residual_deviation", {{"I", residual_[0]}, {"II", residual_[1]}, {"III", residual_[2]}}}}
      .dump();
}

std::string RidgeRegression::summary() const {
  std::ostringstream text;
  text << "terms       " << basis_.size() << " of degree " << basis_.degree() << ", lambda " << lambda_;
  return text.str();
}

void RidgeRegression::write_fit(ByteWriter& out) const {
  basis_.write(out);
  for (const std::vector<double>& beta : beta_)
    out.put_all(std::span<const double>(beta));
  out.put_all(std::span<const double>(factor_));
  for (const double s : residual_)
    out.put(s);
}

std::unique_ptr<Regressor> RidgeRegression::read(TrainingRecord record, const std::string& settings,
                                                 ByteReader& fit) {
  const json d = json::parse(settings);
  auto ridge = std::make_unique<RidgeRegression>(RidgeRegression(std::move(record)));
  ridge->lambda_ = d.at("lambda");
  ridge->basis_ = TermBasis::read(fit, ridge->ranges().size(), d.at("degree"));
  const std::size_t terms = ridge->basis_.size();
  for (std::vector<double>& beta : ridge->beta_)
    beta = fit.get_all<double>(terms);
  ridge->factor_ = fit.get_all<double>(terms * (terms + 1) / 2);
  for (double& s : ridge->residual_)
    s = fit.get<double>();
  const auto finite = [](double v) { return std::isfinite(v); };
  for (const std::vector<double>& beta : ridge->beta_)
    if (!std::all_of(beta.begin(), beta.end(), finite)) throw InputError("a coefficient is not finite");
  if (!std::all_of(ridge->factor_.begin(), ridge->factor_.end(), finite) || !ridge->residual_.allFinite())
    throw InputError("its spread is not finite");
  if (ridge->provenance().samples == 0) throw InputError("the number of samples is wrong");
  return ridge;
}

RegressorKind ridge_kind() {
  RegressorKind kind;
  kind.name = "ridge";
  kind.title = "ridge regression";
  kind.magic = "CNCHRIDG";
  kind.options = {{"degree", "1: the features; 2: their squares and products as well", RidgeSettings().degree,
                   1, 2, true},
                  {"lambda",
                   "penalty λ on the coefficients; chosen by leaving out runs if not given",
                   {},
                   kSmallestLambda,
                   kLargestLambda,
                   false}};
  kind.train = [](const SampleSet& samples, const TrainingSettings& wanted, Provenance provenance,
                  const TrainingProgress&) -> std::unique_ptr<Regressor> {
    const RegressorKind& own = regressor_kind("ridge");
    RidgeSettings settings;
    settings.features = wanted.features;
    settings.degree = whole_option_value(own, wanted, "degree");
    settings.lambda = option_value(own, wanted, "lambda");
    return std::make_unique<RidgeRegression>(
        RidgeRegression::train(samples, settings, std::move(provenance)));
  };
  kind.read = &RidgeRegression::read;
  return kind;
}

}  // namespace conchoid
