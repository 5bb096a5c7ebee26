#pragma once

#include <array>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "conchoid/learn/regressor.hpp"
#include "conchoid/learn/term_basis.hpp"

namespace conchoid {

struct RegressorKind;

struct RidgeSettings {
  FeatureSet features = FeatureSet::paper_4;
  int degree = 2;                ///< 1: the features; 2: their squares and products as well
  std::optional<double> lambda;  ///< λ, 1e-12 … 1e6; none: the one that predicts left-out runs best
};

/// Ridge regression (Hoerl & Kennard, Technometrics 1970), one per fracture mode. With standardised terms z of the
/// features (term_basis.hpp), standardised labels y and n samples, β minimises
///   (1/n) Σ (y − zᵀβ)² + λ |β|²        so  A β = (1/n) Σ z y,   A = (1/n) Σ z zᵀ + λ 1
/// Spread, with the residual deviation s of the training and the leverage of the row:
///   s √(1 + 1/n + zᵀA⁻¹z / n),   s² = Σ (y − zᵀβ)² / (n − 1 − tr(1 − λA⁻¹))
/// Nothing depends on the units of the features. λ is one for the three modes: unless it is given, of the powers of ten
/// 1e-8 … 1 that with the least error on groups of whole runs left out in turn (every run, or 16 groups if there are
/// more); 1e-6 where there is one run only.
class RidgeRegression : public Regressor {
 public:
  /// Throws InputError as prepare_training does, or if a setting is out of its range.
  static RidgeRegression train(const SampleSet& samples, const RidgeSettings& settings,
                               Provenance provenance = {});
  /// What write_fit wrote, back (RegressorKind::read).
  static std::unique_ptr<Regressor> read(TrainingRecord record, const std::string& settings, ByteReader& fit);

  std::string_view name() const override { return "ridge"; }
  std::string settings_json() const override;
  std::string fit_json() const override;
  std::string summary() const override;

  int degree() const { return basis_.degree(); }
  double lambda() const { return lambda_; }
  /// s of the standardised labels, modes I, II, III.
  const Vec3& residual_deviation() const { return residual_; }

 protected:
  void predict_standardised(const FeatureMatrix& rows, std::size_t begin, std::size_t end,
                            std::span<Prediction> out) const override;
  void write_fit(ByteWriter& out) const override;

 private:
  explicit RidgeRegression(TrainingRecord record) : Regressor(std::move(record)) {}

  TermBasis basis_;
  double lambda_ = 0;
  std::array<std::vector<double>, 3> beta_;  // per mode, one per term
  std::vector<double> factor_;               // L of A = LLᵀ, row after row up to the diagonal
  Vec3 residual_ = Vec3::Zero();
};

/// The entry in the list of kinds.
RegressorKind ridge_kind();

}  // namespace conchoid
