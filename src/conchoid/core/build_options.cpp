#include "conchoid/core/build_options.hpp"

#include "conchoid/core/error.hpp"

namespace conchoid {

void throw_built_without(const std::string& what, const std::string& library, const std::string& option) {
  throw InputError(what + ": this conchoid was built without " + library + "; rebuild it with -D" + option +
                   "=ON");
}

}  // namespace conchoid
