#include "conchoid/io/outcome.hpp"

#include <ostream>

namespace conchoid {

std::ostream& operator<<(std::ostream& out, StopReason reason) {
  return out << name(reason);
}

}  // namespace conchoid
