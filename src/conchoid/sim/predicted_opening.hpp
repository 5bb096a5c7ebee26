#pragma once

#include <limits>
#include <optional>

#include "conchoid/learn/opening_predictor.hpp"
#include "conchoid/sim/expected_error.hpp"
#include "conchoid/sim/front_surroundings.hpp"
#include "conchoid/sim/opening_source.hpp"

namespace conchoid {

/// What predicted openings start from. All of it must outlive the source.
struct PredictionContext {
  BemOpening& bem;
  const MaterialSpec& material;
  const PreparedBody& body;
  SifSettings sif;
  int solve_every = 0;  ///< N: frames 1, 1 + N, 1 + 2N … are solved; 0: frame 1 alone
  /// Largest error to be expected of the surface, over the body's diagonal; where that would be more, were
  /// a frame and all after it predicted, it is solved. 0: every frame; none: nobody asks.
  std::optional<double> tolerance = {};
};

/// Whether a frame may be predicted, where `expected` is the error of the whole surface in the end if it is and all after it
/// are, and X the one that is allowed: X is, but a run that is solving begins to predict only within kShareToStopSolving of it.
/// A frame solved behind predicted ones needs the rows of these, too: what was saved is paid after all.
bool may_predict(double expected, double tolerance, bool solving);
inline constexpr double kShareToStopSolving = 0.5;

/// Frame 1 by boundary elements, and every Nth after it where that is asked for; the others are predicted. A
/// later frame that cannot be solved (SingularSystem) is predicted, too.
///
/// With a tolerance X (methods "hybrid") a prediction is looked at first: the frame is solved if the whole surface
/// would be expected farther than X from the solved one in the end (ExpectedError) were all frames predicted from here on
/// until the fronts are through (may_predict), if no point of the front would move, or if X = 0. So early frames are solved,
/// whose rows are few and whose errors all that follows would inherit, and the last ones predicted. X = 0 is the solution
/// bit for bit, frames that cannot be solved among it: they are carried, not predicted. X = ∞ is the prediction.
class PredictedOpening : public OpeningSource {
 public:
  std::vector<FrontOpening> open(const CrackState& crack) final;
  bool solved() const final { return solved_; }
  bool solves(int frame) const final { return looks() || is_due(frame); }
  bool solves_later_frames() const final { return solve_every_ > 0 || looks(); }
  std::optional<double> expected_error() const final;
  void take_carried(const CrackState& crack, const std::vector<FrontOpening>& openings) final;

 protected:
  /// @param statement  what errors are expected by
  explicit PredictedOpening(const PredictionContext& context,
                            const ExpectedError::Statement& statement = ExpectedError::kUnknown);
  /// Opening and K at every point, as open(); points of which nothing is known are marked.
  virtual std::vector<FrontOpening> predict(const CrackState& crack) const = 0;
  /// What else is to be known of the cracks as they stand, before they are solved or predicted, and after.
  virtual void look_at(const CrackState& /*crack*/) {}
  virtual void remember(const CrackState& /*crack*/, const std::vector<FrontOpening>& /*openings*/) {}
  /// What front nodes were like when they were last on the front.
  const FrontHistory& history() const { return history_; }
  /// K of a point, in its own frame, and the opening that belongs to it.
  void set_intensity(const FrontPoint& point, const Vec3& K, FrontOpening& out) const;
  const SifSettings& sif() const { return sif_; }
  const BemOpening& bem() const { return bem_; }
  const ElasticConstants& material() const { return material_; }

 private:
  bool is_due(int frame) const;
  // Whether predictions may be rejected.
  bool looks() const { return tolerance_ && *tolerance_ < std::numeric_limits<double>::infinity(); }
  bool is_good(const CrackState& crack, const std::vector<FrontOpening>& predicted) const;
  bool any_moves(const CrackState& crack, const std::vector<FrontOpening>& predicted) const;
  std::vector<FrontOpening> predicted(const CrackState& crack) const;
  std::optional<std::vector<FrontOpening>> solve(const CrackState& crack);

  BemOpening& bem_;
  const TriMesh& surface_;
  double crack_edge_;
  SifSettings sif_;
  ElasticConstants material_;
  double toughness_;  // of the material
  const MaterialField& toughness_factor_;
  int solve_every_;
  std::optional<double> tolerance_;
  ExpectedError error_;
  bool solved_ = false;
  FrontHistory history_;
};

/// The opening of each point follows by an OpeningPredictor, a regressor or a closed form, from the K which
/// its correlation node had when it was on the front. Linear in the number of front points.
class OpeningByPredictor : public PredictedOpening {
 public:
  /// @param predictor  must outlive the source
  OpeningByPredictor(const PredictionContext& context, const OpeningPredictor& predictor);
  std::string name() const override { return std::string(predictor_.name()); }

 private:
  std::vector<FrontOpening> predict(const CrackState& crack) const override;
  void look_at(const CrackState& crack) override;
  void remember(const CrackState& crack, const std::vector<FrontOpening>& openings) override;
  FrontOpening answer(const FrontPoint& point, NodeId old, const OpeningPrediction& prediction) const;
  Vec3 turned_spread(const FrontFrame& before, const FrontPoint& point, const Vec3& spread) const;

  const OpeningPredictor& predictor_;
  std::unique_ptr<FrontSurroundings> surroundings_;  // none: the predictor does not look around
};

/// "K stays as it is in the front's own frame": (K_I, K_II, K_III) of a point are those which its correlation
/// node had on the front, whatever way the front has turned since. The closed form `steady` keeps the opening
/// fixed in space instead, so that a turn by φ mixes its modes; where nothing turns the two agree.
class KeptOpening : public PredictedOpening {
 public:
  explicit KeptOpening(const PredictionContext& context) : PredictedOpening(context) {}
  std::string name() const override { return "kept"; }

 private:
  std::vector<FrontOpening> predict(const CrackState& crack) const override;
};

}  // namespace conchoid
