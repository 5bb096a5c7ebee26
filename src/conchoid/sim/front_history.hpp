#pragma once

#include <optional>
#include <unordered_map>
#include <vector>

#include "conchoid/learn/features.hpp"
#include "conchoid/sim/crack_state.hpp"
#include "conchoid/sim/scene.hpp"

namespace conchoid {

struct FrontOpening;

/// Remembers what each front node was like when it last was on the front, and pairs it with the front one
/// frame later: when a front advances, its old node becomes the correlation node of the new one. One sample
/// per such pair.
class FrontHistory {
 public:
  /// @param toughness  factor on the material's
  FrontHistory(const MaterialSpec& material, const MaterialField& toughness, double resolution)
      : material_(material), toughness_(toughness), resolution_(resolution) {}

  /// Whether `old` was on a front before, so that a point can come from it.
  bool knows(const FrontPoint& point, NodeId old) const;
  /// The sample of a point that comes from the node `old`, its correlation node or what stands for that (front_pasts.hpp); its
  /// labels are left at zero. None where it is not known.
  std::optional<Sample> sample(const CrackState& crack, const FrontPoint& point, NodeId old) const;
  /// What is remembered of a node.
  struct Entry {
    FrontFrame frame;
    Vec3 intensity;   ///< K from the opening of its own correlation node
    double distance;  ///< of that node
    int seen;         ///< frame of the sheet
    Vec3 driving;     ///< K that moved it
  };
  const Entry* find(NodeId node) const;
  /// Those that were remembered last.
  const std::vector<NodeId>& last() const { return last_; }
  /// Remembers the points as they are now, but for those of which nothing is known.
  /// @param openings  in the order of crack.points
  void remember(const CrackState& crack, const std::vector<FrontOpening>& openings);

 private:
  MaterialSpec material_;
  MaterialField toughness_;
  double resolution_;
  std::unordered_map<NodeId, Entry> entries_;
  std::vector<NodeId> last_;
};

}  // namespace conchoid
