#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "conchoid/crack/fine/fine_front.hpp"
#include "conchoid/io/outcome.hpp"
#include "conchoid/sim/body_cut.hpp"
#include "conchoid/sim/crack_sites.hpp"
#include "conchoid/sim/opening_source.hpp"

namespace conchoid {

class Fracture;

/// What a point of the front does in a frame; in the order of CrackState::points.
struct FrontDecision {
  double drive = 0;      ///< K_eff [Pa√m]
  double toughness = 0;  ///< K_c there [Pa√m]
  double length = 0;     ///< by which it advances [m]; 0: it stays
  double angle = 0;      ///< of its direction, from e2 towards e1 [rad]
};

/// What one step did.
struct StepReport {
  int frame = 0;                         ///< 1 for the first; 0 if there was nothing to do
  bool moving = false;                   ///< another step may change something: `stop` is empty
  std::optional<StopReason> stop;        ///< arrested, separated, intact or singular
  std::string source;                    ///< who gave the opening: "bem", "steady", …, "carried"
  std::optional<double> expected_error;  ///< of the surface so far (OpeningSource::expected_error)
  std::size_t front_points = 0;          ///< of the coarse fronts inside the body, before the advance
  std::size_t crack_triangles = 0;       ///< boundary elements of the cracks, after the advance
  std::size_t new_cracks = 0;            ///< that started in this step
  StressPeak start;                      ///< where the first of these started, and the stress that made it
  double largest_intensity = 0;          ///< K_eff [Pa√m]
  std::vector<std::string> warnings;
  double start_seconds = 0;  ///< of looking for the first crack in the body without one, in the first step
  double opening_seconds = 0, fracture_seconds = 0, other_seconds = 0;
};

/// Sees a fracture as it goes on: recording, progress, checkpoints. What an observer throws ends the step.
class FractureObserver {
 public:
  virtual ~FractureObserver() = default;
  /// A frame begins; nothing of it is computed yet.
  virtual void on_frame(const Fracture&, int /*frame*/) {}
  /// Openings, K and what follows from them are known; the cracks have not grown yet.
  virtual void on_opening(const Fracture&) {}
  /// The frame is over; frame 0 if there was none, as nothing cracked.
  virtual void on_step(const Fracture&, const StepReport&) {}
};

/// Makes the source of the opening from the boundary element solution that every run starts with.
using MakeOpeningSource = std::function<std::unique_ptr<OpeningSource>(BemOpening& bem)>;

/// A body that breaks, frame by frame: solve or predict the opening of its cracks, K along their fronts, new
/// cracks where the stress exceeds the strength, advance.
///
///   Fracture fracture(prepared, load, scene.run);
///   while (fracture.step().moving) {}
///   use(fracture.pieces());
///
/// Same inputs, same bits. Between steps everything can be read, and the load changed. Positions are those of
/// the prepared body, centred at the origin.
class Fracture {
 public:
  /// @param source  empty: every frame is solved by boundary elements
  /// @param law     none: that of the greatest hoop stress, with closed faces or the published treatment of
  ///                compression as the settings say
  /// Throws ComputationError when the body's system is singular.
  Fracture(std::shared_ptr<const PreparedBody> body, LoadCase load, const RunSpec& settings,
           const MakeOpeningSource& source = {}, std::shared_ptr<const GrowthLaw> law = {});
  ~Fracture();
  Fracture(Fracture&&) noexcept;
  Fracture& operator=(Fracture&&) noexcept;

  /// Computes the next frame; the first step also looks for a crack to start with. After a stop it does
  /// nothing and reports the stop again. Throws ComputationError when the first frame cannot be computed; later
  /// ones that cannot end the run as `singular`, those that cannot be solved after they were carried on for a few frames.
  StepReport step();

  /// Another load of the same kinds from the next step on; a fracture that was arrested or intact goes on.
  void set_load(LoadCase load);

  /// Frames are counted from here on, for a piece of a body that has broken in so many frames; call it before
  /// the first step.
  void count_from(int frames);
  /// Where more than this volume [m³] comes off the boundary elements alone tell so, and the detailed body is not cut: for
  /// runs whose pieces nobody wants. Call it before the first step; without it every separation is cut.
  void cut_below(double volume);

  /// Must outlive the fracture. Called in the order they were added.
  void add_observer(FractureObserver& observer);
  /// Where the rows of the cracks are looked for and kept (bem/row_store.hpp); must outlive the fracture.
  void keep_rows(RowStore* store);

  const PreparedBody& body() const;
  /// The same, to be kept for longer than the fracture.
  std::shared_ptr<const PreparedBody> shared_body() const;
  const RunSpec& settings() const;
  const LoadCase& load() const;
  /// How often it was replaced.
  std::size_t loads() const;
  /// Number of frames whose opening is known, and of those counted from.
  int frame() const;
  std::optional<StopReason> stop() const;
  const CrackState& crack() const;
  /// Opening, K and decisions of the last frame, in the order of crack().points as they were in that frame:
  /// for observers in on_opening().
  const std::vector<FrontOpening>& openings() const;
  const std::vector<FrontDecision>& decisions() const;
  /// Whether these come from a solution, and not from a prediction or from frames before.
  bool solved() const;
  /// What boundary elements say of the last frame where they give the openings of all frames, or are asked beside those that
  /// do (LedOpening); null where they could not say.
  const std::vector<FrontOpening>* truth() const;
  /// The body as it was last solved: displacement, traction, stress.
  const CrackedBody& solution() const;
  /// What fronts were like in the frames before.
  const FrontHistory& history() const;
  /// Speed of a front that nothing holds back: Rayleigh's [m/s].
  double rayleigh_speed() const;
  /// Cracks that started in it.
  std::size_t new_cracks() const;
  /// Cracks that started or were there.
  std::size_t cracks() const;

  /// The visible crack surfaces as swept (they may stick out), one sheet per crack, with the last row of the
  /// markers that are ahead of it.
  const std::vector<TriMesh>& visible_sheets() const;
  /// The same in one, as the markers have swept it: it may be folded or pass through itself.
  TriMesh swept_surface() const;
  /// The detailed body as it was cut when it separated; null before, and where the settings do not ask for it.
  const BodyCut* parted() const;
  /// Volume of what has come off, all but the largest piece [m³]; 0 before it separates.
  double volume_off() const;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

/// Steps until the fracture stops, `limit` frames are computed or the user interrupts. Says which.
/// @param progress  called after every step; may be empty
StopReason run_frames(Fracture& fracture, int limit, const std::function<void()>& progress = {});

}  // namespace conchoid
