#pragma once

#include <functional>
#include <memory>
#include <vector>

#include "conchoid/sim/pieces.hpp"

namespace conchoid {

/// Makes, for a body, what makes its source of the opening; see MakeOpeningSource.
using OpeningSourceFor = std::function<MakeOpeningSource(const PreparedBody&)>;

struct BreakupSettings {
  enum class After {
    scene,  ///< as run.after_separation says
    chips,  ///< goes on with the largest piece as long as nothing of the size run.smallest_body has come off, and
            ///< that counts as no separation: for databases. What has come apart is not cut otherwise
    stop  ///< ends with the first body, which is not cut
  };
  After after = After::scene;
  OpeningSourceFor source = {};  ///< empty: every frame is solved by boundary elements
};

/// A body that breaks until nothing moves any more. It is a Fracture, and where that comes apart each piece
/// that carries load goes on as a Fracture of its own (piece_scene.hpp), one after the other: held parts stay
/// held, others are accelerated by their load. A piece is done
///  - without load, or without a crack that ends in it when no more may start (run.max_cracks, of all bodies);
///  - below run.smallest_body of the first body's volume, or below 8 r̄³: the elements see nothing smaller;
///  - when there are run.max_fragments pieces;
///  - when nothing in it moves. A piece in which nothing moves from the start takes no frame.
///
///   Breakup breakup(scene, prepared);
///   while (breakup.step().moving) {}
///   use(breakup.take_pieces());
///
/// Frames are counted on through all bodies, in what observers see, too. Same inputs, same bits.
class Breakup {
 public:
  /// @param scene  conditions, settings and output; @param body  of that scene, made ready
  Breakup(const Scene& scene, std::shared_ptr<const PreparedBody> body, BreakupSettings settings = {});
  ~Breakup();
  Breakup(Breakup&&) noexcept;
  Breakup& operator=(Breakup&&) noexcept;

  /// Must outlive the object. A body's own stop is in the report that its observers get.
  void add_observer(FractureObserver& observer);
  /// As Fracture::keep_rows(): rows of different bodies have different names.
  void keep_rows(RowStore* store);

  /// The next frame, of the body that breaks or of the next one. `stop` is that of the whole: separated as soon
  /// as there are two pieces, never with one. Throws as Fracture::step() does for the first body; a piece that
  /// cannot be computed stays as it is, with a warning.
  StepReport step();
  /// Steps until nothing moves, `limit` frames are computed, or the user interrupts, and cuts. Says which.
  /// @param progress  called after every step; may be empty
  StopReason run(int limit, const std::function<void()>& progress = {});

  /// Frames computed, of all bodies.
  int frame() const;
  /// Cracks that started, or were there in the first body.
  std::size_t cracks() const;
  /// The body that breaks, or broke last.
  const Fracture& fracture() const;
  /// Boundary elements of the body in which something moved last, and of its cracks.
  std::size_t triangles() const;
  /// What the body is in when it has ended (step() or run() says stop), with the warnings of cutting it. To be
  /// called once.
  Pieces take_pieces();

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace conchoid
