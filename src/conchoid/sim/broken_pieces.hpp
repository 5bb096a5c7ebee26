#pragma once

#include "conchoid/sim/pieces.hpp"

namespace conchoid {

/// The pieces of a body while pieces of it break further. All in the body's coordinates. Fragment::source of
/// every piece leads back to the body: original faces to its detailed surface, fracture faces to the sheets,
/// counted through all cuts in their order.
class BrokenPieces {
 public:
  /// @param body  that broke; @param pieces  what it was cut into
  BrokenPieces(std::shared_ptr<const PreparedBody> body, Pieces pieces, const OutputSpec& output);

  /// The first cut's pieces have the ids 0, 1, …; those that come later go on from there.
  std::size_t count() const;
  /// Piece `id` has broken as a body of its own (body_from_fragment()). Returns the id of the first of the new
  /// ones; they follow each other in their order.
  std::size_t replace(std::size_t id, Pieces parts);

  /// What there is, largest first. Where a piece has gone on breaking, contacts and attributes are made anew.
  Pieces take();

 private:
  void trace_back(Fragment& part, const Fragment& parent) const;

  struct Entry {
    Fragment fragment;
    bool broken = false;
  };
  std::shared_ptr<const PreparedBody> body_;
  OutputSpec output_;
  Pieces all_;  // without the fragments
  std::vector<Entry> entries_;
  std::size_t sheet_triangles_ = 0;  // of the cuts so far
};

}  // namespace conchoid
