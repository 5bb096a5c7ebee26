#pragma once

#include "conchoid/intersect/corefine.hpp"

namespace conchoid {

/// The smallest part of the input surface a node lies on: it may move within it only, or the cut surface
/// would change its shape.
struct SurfaceSupport {
  enum class Kind : std::uint8_t {
    none,
    vertex,
    edge,
    face
  } kind = Kind::none;  ///< none: a node inside the body
  Edge edge{NodeId(), NodeId()};
  TriId face;
  NodeId outside;  ///< of a mouth node on a sheet edge: the sheet's node on the outer end of that edge
};

/// Removes slivers along the mouth of a cut: collapses short edges at mouth nodes (onto the surface's own
/// nodes where possible), pulls nodes that almost lie on an edge into it, and flips edges inside a cut
/// triangle. Each change is made only if the complex stays valid (closed manifold surface in its own planes,
/// no piece turned over, mouth a curve with the same ends) and its worst piece gets better.
/// A mouth node takes the place of the sheet's node just inside or outside (`sheet_node`).
/// @param supports  per node of the complex
/// @param across    how far a node may leave the plane of the sheet's triangles on its way, likewise
/// @param merge     shortest edge and altitude aimed at, as a fraction of the size of the triangles that meet
/// there
void merge_mouth(CutComplex& cut, const TriMesh& surface, const TriMesh& sheet,
                 IdVector<NodeId, SurfaceSupport> supports, double merge, double across);

}  // namespace conchoid
