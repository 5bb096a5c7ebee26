#pragma once

#include <vector>

#include "conchoid/mesh/tri_mesh.hpp"

namespace conchoid {

/// A point of the fine front.
struct Marker {
  NodeId node;  ///< last node it left in the fine sheet
  Vec3 position = Vec3::Zero();
  bool moved = false;        ///< in this frame
  NodeId coarse;             ///< the coarse front node attached to it; else invalid
  bool arrested = false;     ///< it has run into the face of a crack …
  bool at_own_face = false;  ///< … its own
  double parameter = 0;      ///< k + s: fraction s of the way from coarse node k of its front to the next
  double offset = 0;         ///< of one with a node attached: how far it stands beyond that, in parameters
};

/// The markers along one coarse front, in the order of its nodes.
struct MarkerCurve {
  std::vector<Marker> markers;
  bool closed = false;
  int part = 0;  ///< connected part of the sheet it belongs to

  std::size_t size() const { return markers.size(); }
  std::size_t next(std::size_t i) const;
  std::size_t previous(std::size_t i) const;
  /// Distance from marker i to the next one.
  double spacing(std::size_t i) const;
};

/// Gives each marker its place between the coarse nodes attached before and after it, by arc length; on a
/// ring from 0 on, which it is turned to start at. @param coarse  nodes of the coarse front
void set_parameters(MarkerCurve& curve, const std::vector<NodeId>& coarse);

/// Attaches coarse nodes that have moved on their own to the markers nearest to them, of those next to the one
/// they were attached to, and tells the markers how far off they are (offset).
/// @param coarse     nodes of the coarse front
/// @param positions  of the sheet's nodes
void reattach_nodes(MarkerCurve& curve, const std::vector<NodeId>& coarse,
                    const IdVector<NodeId, Vec3>& positions);

/// Point of the curve at a parameter (of `coarse_nodes` coarse nodes), for coarse nodes attached to no
/// marker.
Vec3 point_at(const MarkerCurve& curve, double parameter, std::size_t coarse_nodes);

/// Index of the marker nearest to the fraction s of the arc from marker a forward to marker b; neither of
/// them unless `ends`.
std::size_t marker_between(const MarkerCurve& curve, std::size_t a, std::size_t b, double s, bool ends);

/// Attaches coarse nodes to markers nearer to the middle of their neighbours, a quarter of the way, where their
/// two coarse edges differ a lot: keeps coarse edges even without leaving the fine front.
/// @param may_slide  per coarse node of the front (`coarse`)
void slide_attached_nodes(MarkerCurve& curve, const std::vector<NodeId>& coarse,
                          const std::vector<bool>& may_slide);

}  // namespace conchoid
