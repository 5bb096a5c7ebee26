#include "conchoid/sim/waiting_piece.hpp"

#include <utility>

#include "conchoid/core/error.hpp"
#include "conchoid/sim/mended_fragment.hpp"

namespace conchoid {

void WaitingPiece::make_ready() {
  try {
    mend_fragment(fragment);
    own_ = scene_of_piece(*scene, *body, fragment);
  } catch (const InputError&) {
    refused_ = std::current_exception();
  } catch (const ComputationError&) {
    refused_ = std::current_exception();
  }
}

PieceScene WaitingPiece::take() {
  if (refused_) std::rethrow_exception(std::exchange(refused_, nullptr));
  return *std::exchange(own_, std::nullopt);
}

}  // namespace conchoid
