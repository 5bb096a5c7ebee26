#pragma once

#include <array>
#include <memory>
#include <string>
#include <vector>

#include "conchoid/learn/boosting.hpp"
#include "conchoid/learn/regressor.hpp"

namespace conchoid {

struct RegressorKind;

/// Gradient-boosted trees, one ensemble per fracture mode (boosting.hpp): kMembers of them, each fitted to all groups of
/// runs but one (run_groups.hpp), so that none has as many trees as fit its own samples best. Mean and spread of their
/// answers: members.hpp.
class BoostedTrees : public Regressor {
 public:
  /// Throws InputError as prepare_training does.
  static BoostedTrees train(const SampleSet& samples, FeatureSet features, const BoostingSettings& settings,
                            Provenance provenance = {}, const TrainingProgress& progress = {});
  /// What write_fit wrote, back (RegressorKind::read).
  static std::unique_ptr<Regressor> read(TrainingRecord record, const std::string& settings, ByteReader& fit);

  std::string_view name() const override { return "boosted"; }
  std::string settings_json() const override;
  std::string fit_json() const override;
  std::string summary() const override;
  std::vector<const TreeEnsemble*> ensembles(int mode) const override {
    std::vector<const TreeEnsemble*> all;
    for (const TreeEnsemble& member : members(mode))
      all.push_back(&member);
    return all;
  }

  const std::vector<TreeEnsemble>& members(int mode) const {
    return members_[static_cast<std::size_t>(mode)];
  }

  static constexpr int kMembers = 4;

 protected:
  void predict_standardised(const FeatureMatrix& rows, std::size_t begin, std::size_t end,
                            std::span<Prediction> out) const override;
  void write_fit(ByteWriter& out) const override;

 private:
  BoostedTrees(TrainingRecord record, const BoostingSettings& settings)
      : Regressor(std::move(record)), settings_(settings) {}

  BoostingSettings settings_;
  std::array<std::vector<TreeEnsemble>, 3> members_;
};

/// The entry in the list of kinds.
RegressorKind boosted_kind();

}  // namespace conchoid
