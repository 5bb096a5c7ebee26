#pragma once

#include <memory>

#include "conchoid/sim/opening_source.hpp"

namespace conchoid {

/// Fronts go by what another source predicts, as they do without this one, to the bit; every frame is solved by boundary
/// elements all the same, to know what is true where predictions lead (truth()). What a predictor learns from such frames
/// are answers to its own errors, not to fronts that never err (data set aggregation: Ross, Gordon and Bagnell 2011).
class LedOpening : public OpeningSource {
 public:
  /// @param bem  of the same body; must outlive the source
  LedOpening(BemOpening& bem, std::unique_ptr<OpeningSource> leader)
      : bem_(bem), leader_(std::move(leader)) {}
  std::string name() const override { return leader_->name(); }
  std::vector<FrontOpening> open(const CrackState& crack) override;
  bool solved() const override { return leader_->solved(); }
  /// All are: the crack is cut for boundary elements.
  bool solves(int /*frame*/) const override { return true; }
  bool solves_later_frames() const override { return leader_->solves_later_frames(); }
  std::optional<double> expected_error() const override { return leader_->expected_error(); }
  void take_carried(const CrackState& crack, const std::vector<FrontOpening>& openings) override;
  const std::vector<FrontOpening>* truth() const override { return truth_ ? &*truth_ : nullptr; }

 private:
  BemOpening& bem_;
  std::unique_ptr<OpeningSource> leader_;
  std::optional<std::vector<FrontOpening>> truth_;  // none: the frame could not be solved
};

}  // namespace conchoid
