#pragma once

#include <memory>
#include <string>
#include <vector>

#include "conchoid/learn/network_fit.hpp"
#include "conchoid/learn/regressor.hpp"
#include "conchoid/learn/term_basis.hpp"

namespace conchoid {

struct RegressorKind;

/// Small networks with convolution along the front (front_network.hpp), each fitted to all groups of
/// runs but one (run_groups.hpp), the three modes together. Mean and spread of their answers: members.hpp. Features are
/// standardised, and no farther than kFarthest deviations from their mean.
class Network : public Regressor {
 public:
  /// Throws InputError as prepare_training does.
  static Network train(const SampleSet& samples, FeatureSet features, const NetworkSettings& settings,
                       Provenance provenance = {}, const TrainingProgress& progress = {});
  /// What write_fit wrote, back (RegressorKind::read).
  static std::unique_ptr<Regressor> read(TrainingRecord record, const std::string& settings, ByteReader& fit);

  std::string_view name() const override { return "network"; }
  std::string settings_json() const override;
  std::string fit_json() const override;
  std::string summary() const override;

  static constexpr float kFarthest = 4;

 protected:
  void predict_standardised(const FeatureMatrix& rows, std::size_t begin, std::size_t end,
                            std::span<Prediction> out) const override;
  void write_fit(ByteWriter& out) const override;

 private:
  Network(TrainingRecord record, const NetworkSettings& settings)
      : Regressor(std::move(record)), settings_(settings) {}
  /// Columns begin … end, as the networks take them.
  FrontNetwork::Matrix standardised(const FeatureMatrix& rows, std::size_t begin, std::size_t end) const;

  NetworkSettings settings_;
  TermBasis features_;  // of degree 1
  std::vector<FrontNetwork> members_;
};

/// The entry in the list of kinds.
RegressorKind network_kind();

}  // namespace conchoid
