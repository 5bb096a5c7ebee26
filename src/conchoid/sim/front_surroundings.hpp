#pragma once

#include <array>
#include <unordered_map>
#include <vector>

#include "conchoid/learn/sample.hpp"
#include "conchoid/mesh/box_tree.hpp"
#include "conchoid/sim/crack_sizes.hpp"
#include "conchoid/sim/opening_source.hpp"
#include "conchoid/sim/uncracked_stress.hpp"

namespace conchoid {

/// What front points can know of their surroundings without a solution of the cracked body: the stress of the uncracked
/// one, walls, the shape of the front and of its crack, K along the front in the frame before. Fills in what FrontHistory
/// leaves open in samples. Linear in the number of front points, each of them with an integral over the body's surface.
///
///   surroundings.measure(crack, load, version);    // once per frame, before its K are known
///   surroundings.complete(point, sample);
///   surroundings.remember(crack, openings);        // when they are
class FrontSurroundings {
 public:
  /// @param body  must outlive the object
  explicit FrontSurroundings(const PreparedBody& body);

  /// @param version  another one where the load is another
  void measure(const CrackState& crack, const LoadCase& load, std::size_t version);
  /// Everything in a sample but its labels and what FrontHistory::sample() has filled in. @param i  point of the crack
  /// as last measured  @param old  what stands for it in the frame before
  /// @return false where that node was not on the front then
  bool complete(const CrackState& crack, std::size_t i, NodeId old, Sample& sample) const;
  /// Keeps what was measured, and K, for the frame after.
  void remember(const CrackState& crack, const std::vector<FrontOpening>& openings);

 private:
  struct Point {
    FrontFrame frame;
    Mat3 stress = Mat3::Zero();  // in the frame [Pa]
    Vec3 taken = Vec3::Zero();   // over from the crack, in the frame [Pa]
    Vec3 force = Vec3::Zero();   // on the crack, in the frame [N]
    Vec3 moment = Vec3::Zero();  // its moment about the point, likewise [N m]
    double arms = 0;             // K of the crack's sides as beams
    std::array<double, kSides> beside{};
    double ahead = 0, wall = 0, curvature = 0;
    double crack_radius = 0, ligament_share = 0;
    Vec3 driving = Vec3::Zero(), nearby = Vec3::Zero(), slope = Vec3::Zero(), front = Vec3::Zero();
    int seen = -1;  // frame of the sheet
  };
  std::vector<Mat3> stress_at_points(const CrackState& crack, const LoadCase& load, std::size_t version);
  void measure_front(const CrackState& crack);
  void measure_crack(const CrackState& crack);
  void measure_sections(const CrackState& crack, const std::vector<CrackSize>& sizes);

  const PreparedBody& body_;
  BoxTree walls_;
  UncrackedStress uncracked_;
  std::vector<Point> points_;
  // At nodes of the sheet inside, in the body's axes, under the load of that version.
  std::unordered_map<NodeId, Mat3> stress_;
  std::size_t version_ = 0;
  std::unordered_map<NodeId, Point> before_;
};

}  // namespace conchoid
