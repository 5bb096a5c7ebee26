#pragma once

#include <array>
#include <span>
#include <vector>

#include "conchoid/bem/boundary.hpp"
#include "conchoid/elastic/constants.hpp"
#include "conchoid/quadrature/pair_integrals.hpp"

namespace conchoid {

/// A triangle at a node, and which of its corners the node is.
struct CornerAt {
  std::size_t triangle;
  int corner;
};

/// An uncracked body in the form in which it is integrated: panels, shape functions, and what is unknown.
/// Unknown are the traction of triangles in the directions that they hold, and the displacement of nodes in the
/// directions that no triangle around them holds. A triangle with any held direction is called held and has three
/// unknowns, a node with any free direction is called free and has three; those of them that are prescribed stand
/// alone in the system and come out as zero.                                            docs/theory.md (B9)
struct BodyDiscretisation {
  /// Errors: InputError when there is not one kind per triangle.
  BodyDiscretisation(TriMesh surface, std::vector<BoundaryKind> kinds, const ElasticConstants& m,
                     double quadrature_tolerance);

  TriMesh surface;
  std::vector<BoundaryKind> kinds;
  ElasticConstants m;
  PairIntegrator integrator;
  std::vector<Panel> panels;                  ///< per triangle
  std::vector<std::array<Vec3, 3>> curls;     ///< per triangle, of its corner functions
  std::vector<std::vector<CornerAt>> around;  ///< per node
  std::vector<TriId> held_triangles;
  std::vector<NodeId> free_nodes;
  std::vector<int> traction_unknown;       ///< per triangle: position in held_triangles, or −1
  std::vector<int> displacement_unknown;   ///< per node: position in free_nodes, or −1
  std::vector<Mat3> unknown_traction;      ///< per held triangle: projection onto its held directions
  std::vector<Mat3> unknown_displacement;  ///< per free node: projection onto its free directions

  std::size_t tractions() const { return 3 * held_triangles.size(); }     ///< unknown components
  std::size_t displacements() const { return 3 * free_nodes.size(); }     ///< unknown components
  std::size_t unknowns() const { return tractions() + displacements(); }  ///< unknown components

  /// Takes what is prescribed out of a vector (q, u).
  void keep_unknown(double* x) const;
};

/// Where a block of entries goes: entry (i, j) at data[i·row + j·column].
struct BlockView {
  double* data;
  std::size_t row, column;
};

/// Entries of the body's operators, by sub-matrix: V single layer, K double layer, D hypersingular. Any
/// triangles and nodes may be asked for, unknown or prescribed; each stands for three rows or columns of the
/// block. An entry has the same bits in every block that holds it.               docs/theory.md (B1)–(B5)
/// Blocks are computed on the calling thread; several threads may ask at once.
/// system_…: the same blocks as they stand in the system, between held triangles and free nodes: P B Q with the
/// projections onto what is unknown, and s (I − P) added where a triangle or node meets itself, s a third of the
/// block's trace.                                                                       docs/theory.md (B9)
class BodyEntries {
 public:
  explicit BodyEntries(const BodyDiscretisation& body) : body_(body) {}  ///< `body` must outlive it

  const BodyDiscretisation& body() const { return body_; }

  void single_layer(std::span<const TriId> rows, std::span<const TriId> columns, BlockView out) const;
  void double_layer(std::span<const TriId> rows, std::span<const NodeId> columns, BlockView out) const;
  void hypersingular(std::span<const NodeId> rows, std::span<const NodeId> columns, BlockView out) const;

  void system_single_layer(std::span<const TriId> rows, std::span<const TriId> columns, BlockView out) const;
  void system_double_layer(std::span<const TriId> rows, std::span<const NodeId> columns, BlockView out) const;
  void system_hypersingular(std::span<const NodeId> rows, std::span<const NodeId> columns,
                            BlockView out) const;

  /// Integrates the single layer of every pair of triangles and keeps it, 28 n² bytes for n triangles: for
  /// who will ask for the whole of D. Without it each block integrates the pairs it needs.
  void keep_pairs();
  void drop_pairs() { pairs_.clear(); }

 private:
  std::vector<PanelPair> pairs_with(std::size_t x, std::span<const std::size_t> others) const;
  /// The single layer of x with each of the others.
  std::vector<SingleLayerPair> row(std::size_t x, std::span<const std::size_t> others) const;

  const BodyDiscretisation& body_;
  std::vector<SingleLayerPair> pairs_;  // (x, y), x ≥ y, at x (x+1)/2 + y
};

}  // namespace conchoid
