#pragma once

#include <limits>
#include <unordered_map>
#include <vector>

#include "conchoid/crack/front/sheet.hpp"
#include "conchoid/crack/law/growth_law.hpp"

namespace conchoid {

/// What a coarse front node is to do in one frame.
struct FrontStep {
  NodeId node;  ///< on a front of the sheet
  FrontFrame frame;
  double angle = 0;  ///< θ from e2 towards e1 [rad], GrowthLaw::direction()
  double intensity =
      0;  ///< K_eff [Pa·√m], GrowthLaw::drive(); against the toughness it gives the length; 0: stays
  double limit = std::numeric_limits<double>::infinity();  ///< length it moves at most [m]
  double turn =
      0;  ///< by which the path goes on turning while it is made: from θ at its beginning to θ + turn [rad]
};

/// Steps for all nodes that move: those given, and for nodes outside of the body next to one of them the mean
/// step of their neighbours in their own frame, so that the sheet keeps sticking out where the front runs
/// along the surface.
std::vector<FrontStep> with_drawn_nodes(const CrackSheet& sheet, const std::vector<FrontStep>& steps);

/// The steps along one coarse front as functions of a parameter k + s: fraction s of the edge from node k to
/// the next.
class FrontSteps {
 public:
  /// Nodes without a step, and arrested ones, stay.
  FrontSteps(const CrackSheet& sheet, const SheetFront& front, const IdVector<NodeId, Vec3>& normals,
             const std::unordered_map<NodeId, FrontStep>& given);

  /// Takes node-to-node noise out of θ and the turn: (−1, 4, 10, 4, −1)/16 where five nodes in a row move; exact
  /// for cubics.
  void smooth_angles();

  std::size_t size() const { return nodes_.size(); }
  bool closed() const { return closed_; }
  const std::vector<NodeId>& nodes() const { return nodes_; }
  bool moves(std::size_t k) const { return steps_[k].intensity > 0; }

  /// Frame interpolated; direction interpolated between two nodes that move, else the one's that does.
  /// @param time  share of the step that has been made
  FrontFrame frame(double parameter) const;
  double angle(double parameter, double time) const;
  /// K_eff interpolated likewise [Pa·√m].
  double intensity(double parameter) const;
  /// GrowthLaw::length() of both nodes, interpolated [m].
  double length(double parameter, const GrowthLaw& law, double toughness, double resolution) const;

 private:
  struct Place {
    std::size_t before, after;
    double s;
  };
  Place place(double parameter) const;

  std::vector<NodeId> nodes_;
  bool closed_ = false;
  std::vector<FrontStep> steps_;
};

}  // namespace conchoid
