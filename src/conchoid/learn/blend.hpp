#pragma once

#include <memory>
#include <string>
#include <vector>

#include "conchoid/learn/regressor.hpp"

namespace conchoid {

struct RegressorKind;

/// Several kinds of regressors, fitted to the same samples, of which each counts alike: the mean x̄ of their answers x_i
/// with spreads s_i, and the spread √(Σ(s_i² + (x_i − x̄)²)/n). They err in different places: a forest where its leaves
/// jump, a network where it is far from what it has seen.
class Blend : public Regressor {
 public:
  /// Of a forest, boosted trees and networks, small enough to come with the program (kBlended).
  /// Throws InputError as their training does.
  static Blend train(const SampleSet& samples, FeatureSet features, std::uint64_t seed,
                     const Provenance& provenance = {}, const TrainingProgress& progress = {});
  /// What write_fit wrote, back (RegressorKind::read).
  static std::unique_ptr<Regressor> read(TrainingRecord record, const std::string& settings, ByteReader& fit);

  std::string_view name() const override { return "blend"; }
  std::string settings_json() const override { return "{}"; }
  std::string fit_json() const override;
  std::string summary() const override;
  std::vector<const TreeEnsemble*> ensembles(int mode) const override;

  const std::vector<std::unique_ptr<Regressor>>& members() const { return members_; }

 protected:
  void predict_standardised(const FeatureMatrix& rows, std::size_t begin, std::size_t end,
                            std::span<Prediction> out) const override;
  void write_fit(ByteWriter& out) const override;

 private:
  explicit Blend(TrainingRecord record) : Regressor(std::move(record)) {}

  std::vector<std::unique_ptr<Regressor>> members_;
};

/// The entry in the list of kinds.
RegressorKind blend_kind();

}  // namespace conchoid
