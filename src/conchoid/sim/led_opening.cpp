#include "conchoid/sim/led_opening.hpp"

#include "conchoid/core/error.hpp"

namespace conchoid {

std::vector<FrontOpening> LedOpening::open(const CrackState& crack) {
  truth_.reset();
  std::vector<FrontOpening> out = leader_->open(crack);
  if (leader_->solved()) {
    truth_ = out;
    return out;
  }
  try {
    truth_ = bem_.open(crack);
  } catch (const SingularSystem&) {  // a crumb, or a thread of a ligament: the leader goes on
  }
  return out;
}

void LedOpening::take_carried(const CrackState& crack, const std::vector<FrontOpening>& openings) {
  truth_.reset();
  leader_->take_carried(crack, openings);
}

}  // namespace conchoid
