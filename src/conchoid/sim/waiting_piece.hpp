#pragma once

#include <cstddef>
#include <exception>
#include <memory>
#include <optional>
#include <utility>

#include "conchoid/sim/piece_scene.hpp"

namespace conchoid {

/// A piece that may break, as it was cut from its body.
struct WaitingPiece {
  WaitingPiece(std::size_t number, const Fragment& cut, std::shared_ptr<const PreparedBody> of_body,
               std::shared_ptr<const Scene> of_scene)
      : id(number), fragment(cut), body(std::move(of_body)), scene(std::move(of_scene)) {}

  std::size_t id;  ///< in BrokenPieces
  Fragment fragment;
  std::shared_ptr<const PreparedBody> body;
  std::shared_ptr<const Scene> scene;

  /// Makes a body of its own of it (mend_fragment(), scene_of_piece()), which takes long.
  void make_ready();
  bool ready() const { return own_ || refused_; }
  /// The body, once made ready; it is to be made ready again after. Throws what making it threw.
  PieceScene take();

 private:
  std::optional<PieceScene> own_;
  std::exception_ptr refused_;
};

}  // namespace conchoid
