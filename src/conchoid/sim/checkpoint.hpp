#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "conchoid/bem/row_store.hpp"
#include "conchoid/core/background_queue.hpp"
#include "conchoid/sim/fracture.hpp"

namespace conchoid {

/// What a run leaves behind with every frame, so that it can go on where it was stopped: the rows that the
/// frame's enrichment functions added to the system, one file resume/frame_0001.rows … per frame, each whole or not
/// there. Integrating these rows is what takes the time; a run that goes on computes everything else again
/// and comes to the same bits.
class Checkpoint : public RowStore, public FractureObserver {
 public:
  enum class Earlier { remove, keep };
  /// @param folder    of the run; nothing is written before the first finish()
  /// @param queue     that writes; must outlive this
  /// @param identity  hash of everything the rows depend on: scene, meshes, method, program
  /// @param earlier   what becomes of frames that are there already. `keep` reads them all; throws InputError
  ///                  for a file that is not a checkpoint's, is cut short or damaged, or has another identity
  Checkpoint(std::filesystem::path folder, std::string identity, Earlier earlier, BackgroundQueue& queue);

  /// Frames that were complete when this run began.
  int frames() const { return frames_; }
  /// Rows that follow belong to this frame.
  void on_frame(const Fracture&, int frame) override { begin(frame); }
  /// The frame is complete. Throws WriteError if the disk was full at a frame before.
  void on_step(const Fracture&, const StepReport& step) override { finish(step.frame); }
  /// Removes all of it: the run has ended by itself. The queue has to be finished.
  void remove();

  std::optional<std::vector<EnrichmentRows>> recall(const std::string& name) override;
  void keep(const std::string& name, const std::vector<EnrichmentRows>& rows) override;

 private:
  struct Record {
    std::string name;
    std::vector<EnrichmentRows> rows;
  };
  static void write(const std::filesystem::path& file, const std::string& identity,
                    const std::vector<Record>& records);
  void begin(int frame);
  void finish(int frame);
  std::filesystem::path file(int frame) const;
  std::vector<Record> read(int frame) const;
  void remove_from(int frame);

  std::filesystem::path folder_;
  std::string identity_;
  BackgroundQueue& queue_;
  int frames_ = 0;
  std::vector<Record> records_;  // of the frame that was begun
  std::size_t next_ = 0;         // of these, to be recalled
};

}  // namespace conchoid
