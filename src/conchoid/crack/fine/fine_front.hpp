#pragma once

#include <optional>
#include <vector>

#include "conchoid/crack/closing/front_joint.hpp"
#include "conchoid/crack/fine/face_grid.hpp"
#include "conchoid/crack/fine/front_steps.hpp"
#include "conchoid/crack/fine/front_track.hpp"
#include "conchoid/crack/fine/marker_curve.hpp"

namespace conchoid {

struct FineFrontSettings {
  double resolution = 0;      ///< r̄ [m]
  double spacing = 0;         ///< h [m] of the markers; at most r̄/4 is used
  int sub_steps = 10;         ///< per frame, in which a marker turns; where h is finer each is made in parts
  bool smooth_angles = true;  ///< see FrontSteps::smooth_angles
};

/// The visible crack surface: along every coarse front a polyline of markers, about h apart (kept within 0.5
/// h … 1.5 h), and the fine sheet they sweep. Every coarse front node is attached to one marker; where the
/// toughness varies it lies on the markers' curve smoothed over r̄, as the boundary elements see nothing
/// finer. A frame of r̄/c_R is made in sub-steps; in each a marker moves by
///     GrowthLaw::length(K_eff, K_c(x), r̄) / sub-steps,
/// evaluated with the K_eff of the two coarse nodes it lies between and interpolated, in the interpolated
/// frame, in a direction that turns from the interpolated θ on as the step says (FrontStep::turn). Where the
/// toughness varies, each sub-step turns from there towards its fall (GrowthLaw::deflection), but not beyond the bottom of a valley; and a marker off the front
/// smoothed over r̄ feels what the front's shape does to K, to first order for a wave of wavelength r̄ (Rice
/// 1985): K_eff (1 + π · lag/r̄), and a fall of height/r̄ back to it. Else tough spots would be
/// left behind for good, and neighbours part without end. A marker leaves a row of triangles behind whenever
/// it is half of h from its last one, so slow fronts leave no slivers; its position may be that much ahead of
/// the sheet (see finish()). The body's surface is not seen here.
///
/// A marker stops for good at the face of a crack: half of h before it where it is a face of its own crack,
/// which may not cross itself, and half of h beyond where it is another's, so that the two cut the body
/// together. Markers between coarse nodes that both lie outside of the body are not looked after. Coarse
/// nodes attached to stopped markers are arrested.
///
/// One frame:  motions = fine.advance(sheet, steps, model);
///             result = advance(sheet, motions, r̄, {smoothing 0, between fine.between});  fine.adopt(sheet,
///             result);
/// or advance_fronts(), which does just that.
///
/// A second fine front of other spacing may follow the one that moves the coarse nodes, the driving front: it
/// keeps to the same coarse nodes and lies against the smoothed curve of the driving front instead of its own,
/// so that it shows more or less detail of the same fracture and has no effect on it.
class FineFront {
 public:
  /// The initial fine sheet: the sheet's triangles, each divided uniformly to edges of about h.
  FineFront(const CrackSheet& sheet, const FineFrontSettings& settings);

  /// Takes in the cracks appended to the sheet since it was last seen; advance() does so by itself.
  void append_parts(const CrackSheet& sheet);

  /// Moves the markers by one frame and sweeps the fine sheet. Coarse nodes without a step stay, and so do
  /// markers between two of them. @return the displacements of the coarse nodes
  std::vector<FrontMotion> advance(const CrackSheet& sheet, const std::vector<FrontStep>& steps,
                                   const GrowthModel& model);
  /// The same for a front that follows another, which has advanced already. Where only this one met a face
  /// of its own crack it tries again in the next frame.
  void advance(const CrackSheet& sheet, const std::vector<FrontStep>& steps, const GrowthModel& model,
               const FineFront& driving);

  /// Breaks the ligament between two stretches of fronts, as join_fronts() has just done in the sheet, and
  /// joins what is left of their markers' curves.
  void join(const CrackSheet& sheet, const FrontJoint& joint, const JoinedFronts& joined);

  /// Position of the marker nearest to the fraction s of the way along the markers from coarse node a to b;
  /// none if one of them is attached to no marker.
  std::optional<Vec3> between(NodeId a, NodeId b, double s) const;

  /// Follows the coarse fronts through an advance of the sheet: hands markers over to the new coarse nodes;
  /// where a coarse front has closed, the fine one is closed by a fan.
  void adopt(const CrackSheet& sheet, const AdvanceResult& result);

  /// Leaves a last row of triangles at markers that are ahead of the sheet. At the end of a run.
  void finish();

  /// As used: the spacing is r̄/4 at most.
  const FineFrontSettings& settings() const { return settings_; }
  const TriMesh& surface() const { return surface_; }
  /// Frame of the sheet in which each fine triangle appeared.
  const IdVector<TriId, int>& triangle_birth() const { return birth_; }
  /// As CrackSheet::fronts; empty where the fine front has closed before the coarse one.
  const std::vector<MarkerCurve>& curves() const { return curves_; }
  /// No two successive markers have left nodes farther apart than this [m]: what rows are divided to, or the
  /// longest edge of an initial front.
  double longest_spacing() const { return longest_spacing_; }
  /// Coarse nodes attached to a marker which has run into a face.
  std::vector<NodeId> stopped_nodes() const;

 private:
  /// How a marker lies against the front smoothed over r̄.
  struct FrontPerturbation {
    double intensity = 1;  ///< factor on K_eff: what lags behind gets more
    double height = 0;     ///< towards e1 [r̄]
  };
  /// What a marker is about to do in a sub-step.
  struct Path {
    Vec3 position;
    double length;
    FrontFrame frame;
    double angle, intensity, height;
  };

  /// What holds for all markers in a part of a frame.
  struct SubStep {
    int per_frame = 1;            ///< so many make a frame
    double time = 0;              ///< its middle, as a share of the frame
    std::vector<Toughness> here;  ///< per marker
    std::vector<Vec3> smooth;     ///< where it would be without detail; empty where nothing varies
  };

  std::vector<FrontMotion> advance(const CrackSheet& sheet, const std::vector<FrontStep>& steps,
                                   const GrowthModel& model, const std::vector<FrontTrack>* driving);
  /// One frame of one front. @param inside  per coarse edge  @param driving  track of the front it follows; may be null
  void sweep(MarkerCurve& curve, const FrontSteps& steps, const std::vector<bool>& inside,
             const GrowthModel& model, FrontTrack& track, const FrontTrack* driving);
  /// The nodes between two stretches that have been joined, at their ends (see FrontJoint).
  struct JointEnds {
    std::vector<NodeId> at_first, at_second;  ///< from first.front() on, from second.front() on
  };
  JointEnds fill_ligament(const std::vector<NodeId>& first, const std::vector<NodeId>& second, int part);
  bool move_markers(MarkerCurve& curve, const FrontSteps& steps, const GrowthModel& model,
                    const SubStep& part);
  std::vector<FrontPerturbation> perturbations(const MarkerCurve& curve, const FrontSteps& steps,
                                               const std::vector<Vec3>& smooth) const;
  double weaker_side(const Path& path, const Toughness& here, const GrowthModel& model) const;
  /// Where a coarse node lies that is attached to marker i.
  Vec3 coarse_position(const MarkerCurve& curve, std::size_t i) const;
  /// Stops markers whose path since `from` (positions, one per marker) leads into a face.
  void stop_at_faces(MarkerCurve& curve, const std::vector<Vec3>& from,
                     const std::vector<bool>& inside) const;
  void leave_row(MarkerCurve& curve, double least);
  void close(MarkerCurve& curve);
  void append_motions(const CrackSheet& sheet, MarkerCurve& curve, const FrontSteps& steps,
                      std::vector<FrontMotion>& motions) const;
  void follow(MarkerCurve& curve, const std::vector<FrontSuccession>& succession) const;

  FineFrontSettings settings_;
  TriMesh surface_;
  IdVector<TriId, int> birth_;
  std::vector<MarkerCurve> curves_;
  std::vector<FrontTrack> tracks_;  ///< per curve, of the last frame; empty where nothing varied
  double longest_spacing_;
  FaceGrid faces_;
  std::size_t known_triangles_ = 0;  ///< of the sheet
  int next_part_ = 0;
  int frame_ = 0;
  bool varied_ = false;  ///< the toughness does
};

}  // namespace conchoid
