#pragma once

#include <memory>
#include <vector>

#include "conchoid/core/background_queue.hpp"
#include "conchoid/io/run_folder.hpp"
#include "conchoid/learn/sample.hpp"
#include "conchoid/sim/fracture.hpp"
#include "conchoid/sim/front_surroundings.hpp"

namespace conchoid {

/// One row of front.csv per front point and frame, in the body's coordinates.
class FrontRecorder : public FractureObserver {
 public:
  void on_opening(const Fracture& fracture) override;
  const std::vector<FrontRow>& rows() const { return rows_; }
  std::vector<FrontRow> take() { return std::move(rows_); }

 private:
  std::vector<FrontRow> rows_;
};

/// How far the fronts have come.
class GrowthRecorder : public FractureObserver {
 public:
  void on_opening(const Fracture& fracture) override;
  /// Farthest that any front has travelled [m].
  double largest() const { return largest_; }

 private:
  double largest_ = 0;
};

/// Training samples of a run by boundary elements, or of one that is solved beside what leads it (LedOpening): front elements
/// paired over two successive frames, one for each correlation node: that of the nearest point. Frames that were not solved
/// give none.
class SampleRecorder : public FractureObserver {
 public:
  /// What samples hold: all fields, or those alone that cost nothing.
  enum class Fields { free, all };
  explicit SampleRecorder(Fields fields = Fields::free) : fields_(fields) {}
  void on_opening(const Fracture& fracture) override;
  SampleSet take() { return std::move(samples_); }

 private:
  FrontSurroundings* surroundings(const Fracture& fracture);

  Fields fields_;
  std::shared_ptr<const PreparedBody> body_;  // that the surroundings are of
  std::unique_ptr<FrontSurroundings> surroundings_;
  SampleSet samples_;
};

/// Frames for ParaView, in the body's coordinates.
class FrameWriter : public FractureObserver {
 public:
  /// @param folder  must outlive the queue, which writes; exaggeration  see FrameData
  FrameWriter(RunFolder& folder, BackgroundQueue& queue, double exaggeration)
      : folder_(folder), queue_(queue), exaggeration_(exaggeration) {}
  void on_opening(const Fracture& fracture) override;

 private:
  RunFolder& folder_;
  BackgroundQueue& queue_;
  double exaggeration_;
};

}  // namespace conchoid
