#pragma once

#include <chrono>
#include <optional>

#include "conchoid/crack/fine/fine_front.hpp"
#include "conchoid/sim/checkpoint.hpp"
#include "conchoid/sim/opening_source.hpp"
#include "conchoid/sim/run.hpp"

namespace conchoid {

/// The frames of one run: the body, its cracks and the source of their opening.
class FrameLoop {
 public:
  FrameLoop(const Scene& scene, const RunOptions& options);

  /// Computes frames until something stops it; fills document.stop, frames and timings, front, samples.
  /// @param folder, checkpoint  may be null: nothing is written
  void run(RunResult& result, RunFolder* folder, Checkpoint* checkpoint);

  const BodySetup& setup() const { return setup_; }
  const CrackState& crack() const { return crack_; }
  /// Fine crack surfaces as swept (they may stick out), one sheet per crack, centred coordinates.
  std::vector<TriMesh> fine_sheets() const;
  std::size_t crack_triangles() const { return crack_.trimmed.triangle_count(); }

 private:
  struct Clock;
  std::string guarded_frame(int frame, RunResult& result, RunFolder* folder);
  std::string compute_frame(int frame, RunResult& result, RunFolder* folder);
  /// Opening and K of the frame. A later frame whose system is singular is carried, a few times in a row.
  std::vector<FrontOpening> open(FrameRecord& record, RunResult& result);
  bool solved() const { return !predictor_ && carried_ == 0; }
  void start_cracks(RunResult& result);
  std::vector<FrontStep> record_and_step(int frame, const std::vector<FrontOpening>& openings,
                                         RunResult& result);
  void write_frame(int frame, RunFolder& folder, const std::vector<FrontOpening>& openings);

  const Scene& scene_;
  const RunOptions& options_;
  ElasticConstants m_;
  BodySetup setup_;
  BemOpening bem_;
  std::unique_ptr<OpeningSource> predictor_;  // none: bem_ itself
  FrontHistory history_;
  CrackState crack_;
  FineFront fine_;                    // moves the cracks, h = r̄/10 whatever the scene asks to see
  std::optional<FineFront> visible_;  // none: fine_ itself
  std::shared_ptr<const GrowthLaw> law_;
  ToughnessField toughness_;
  double rayleigh_speed_;
  double largest_intensity_ = 0;  // K_eff of the frame
  int started_ = 0;
  int carried_ = 0;  // frames in a row that could not be solved
  bool warned_ = false;
};

}  // namespace conchoid
