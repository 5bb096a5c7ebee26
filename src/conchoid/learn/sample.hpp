#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string_view>
#include <vector>

#include "conchoid/core/vec.hpp"

namespace conchoid {

inline constexpr std::size_t kSides = 8;  ///< of Sample::beside

/// What one front element did between two frames of a run, in physical quantities (SI) so that every feature
/// set can be computed from it later. Components I, II, III are along e1 (crack normal), e2 (forward), e3
/// (tangent) of the front frame of frame n−1.
struct Sample {
  std::int32_t run = 0;
  std::int32_t frame = 0;      ///< n, the frame the label belongs to
  std::int32_t node = 0;       ///< the front node of frame n−1; in frame n it is the correlation node
  std::int32_t front = 0;      ///< number of its front in frame n; samples of one lie in their order along it
  Vec3 K = Vec3::Zero();       ///< stress intensity factors at frame n−1 [Pa√m]
  double toughness = 1;        ///< K_c at the front node [Pa√m], > 0
  double resolution = 1;       ///< r̄, target edge length of crack triangles [m], > 0
  double distance_before = 1;  ///< distance of the correlation node from the front at frame n−1 [m], > 0
  double distance_after = 1;   ///< the same at frame n [m], > 0: the step the front has just made
  double travelled = 0;        ///< distance the front has travelled since the crack started [m], ≥ 0
  double youngs_modulus = 1;   ///< E [Pa], > 0
  double poisson_ratio = 0.3;  ///< ν, −1 < ν < ½
  // What else is known in linear time; zero where nobody measured it. "After" is the front node of frame n and its own
  // front frame e1′, e2′, e3′, else that of frame n−1.
  double front_curvature = 0;   ///< of the front in the crack plane, positive where the crack is convex [1/m]
  double surface_distance = 0;  ///< from the front node along e2 to the body's surface [m], may be infinite
  /// σ·e1 of the body without this crack at the front node, in the front frame [Pa]
  Vec3 traction = Vec3::Zero();
  Vec3 lateral = Vec3::Zero();         ///< σ22, σ33, σ23 there [Pa]
  double wall_distance = 0;            ///< to the nearest point of the body's surface [m]
  Vec3 driving = Vec3::Zero();         ///< K that moved the front [Pa√m]
  Vec3 driving_nearby = Vec3::Zero();  ///< its mean over the point and its neighbours on the front [Pa√m]
  Vec3 driving_slope = Vec3::Zero();   ///< its change along e3, across the neighbours [Pa√m/m]
  Vec3 driving_front = Vec3::Zero();   ///< its mean over the connected front [Pa√m]
  double crack_radius = 0;             ///< √(area/π) of the crack, after [m]
  double ligament_share = 0;  ///< L/(L + crack area), L what lies straight ahead of its fronts, after; 0 … 1
  double front_curvature_after = 0;    ///< [1/m]
  double surface_distance_after = 0;   ///< [m]
  double wall_distance_after = 0;      ///< [m]
  Vec3 traction_after = Vec3::Zero();  ///< [Pa]
  Vec3 lateral_after = Vec3::Zero();   ///< [Pa]
  /// Traction that the ligament takes over from the crack (sim/net_section.hpp) at the node, in the front frame [Pa]
  Vec3 taken_over = Vec3::Zero();
  Vec3 taken_over_after = Vec3::Zero();
  Vec3 crack_force = Vec3::Zero();   ///< of σ·e1 over the crack, in the front frame, after [N]
  Vec3 crack_moment = Vec3::Zero();  ///< its moment about the node, likewise [N m]
  double arms = 0;  ///< K of the crack's sides as beams that this moment bends (sim/net_section.hpp) [Pa√m]
  double arms_after = 0;  ///< [Pa√m]
  /// From the node to the body's surface along e1, −e1, (e2 ± e1)/√2, (−e2 ± e1)/√2, e3, −e3, after [m], may be infinite
  std::array<double, kSides> beside{};
  Vec3 turn = Vec3::Zero();  ///< what the frame has turned: e2′·e1, e3′·e1, e2′·e3
  /// Label: K that drives the front of frame n, in its own front frame [Pa√m]
  Vec3 driving_after = Vec3::Zero();
  /// Label: Δu of the correlation node at frame n, in the front frame of frame n−1 [m]; zero where is_new_on_front()
  Vec3 opening = Vec3::Zero();
};

/// × r̄: openings beyond it, a triangle behind the front, say nothing in linear elasticity: a piece hangs by a
/// ligament.
inline constexpr double kLargestOpening = 3;
inline bool is_end_game(const Sample& s) {
  return s.opening.norm() >= kLargestOpening * s.resolution;
}

/// Whether its node is new on the front, put between others or come into the body from outside: another one stands for what it
/// was in the frame before (sim/front_pasts.hpp), it has no opening of its own to learn, and `node` is itself.
inline bool is_new_on_front(const Sample& s) {
  return s.opening.isZero(0);
}

/// One real-valued field of a Sample.
struct SampleField {
  std::string_view name;
  std::string_view unit;
};

/// Samples as structure of arrays: one array per field.
class SampleSet {
 public:
  static constexpr std::size_t field_count = 73;
  /// Names and units of the real-valued fields, in the order of field(); part of every file format.
  static const std::array<SampleField, field_count>& fields();

  std::size_t size() const { return run_.size(); }
  bool empty() const { return run_.empty(); }
  void reserve(std::size_t n);
  void resize(std::size_t n);
  void add(const Sample& sample);
  void append(const SampleSet& other);
  Sample operator[](std::size_t i) const;
  SampleSet subset(const std::vector<std::size_t>& indices) const;

  const std::vector<double>& field(std::size_t f) const { return values_[f]; }
  std::vector<double>& field(std::size_t f) { return values_[f]; }
  const std::vector<std::int32_t>& run() const { return run_; }
  const std::vector<std::int32_t>& frame() const { return frame_; }
  const std::vector<std::int32_t>& node() const { return node_; }
  const std::vector<std::int32_t>& front() const { return front_; }
  std::vector<std::int32_t>& run() { return run_; }
  std::vector<std::int32_t>& frame() { return frame_; }
  std::vector<std::int32_t>& node() { return node_; }
  std::vector<std::int32_t>& front() { return front_; }

  /// Whether two samples that follow each other are neighbours along a front.
  bool neighbours(std::size_t i, std::size_t next) const {
    return run_[i] == run_[next] && frame_[i] == frame_[next] && front_[i] == front_[next];
  }
  /// Hash of the content, the same on every machine.
  std::uint64_t hash() const;
  /// Throws InputError that names the first sample whose numbers are not finite or outside their range.
  void validate() const;

  bool operator==(const SampleSet&) const = default;

 private:
  std::vector<std::int32_t> run_, frame_, node_, front_;
  std::array<std::vector<double>, field_count> values_;
};

}  // namespace conchoid
