#pragma once

#include <string>

namespace conchoid {

/// Throws InputError: `what` cannot be had, for the library was built without `library`; how to build it with.
/// @param option  the switch of the build, e.g. "CONCHOID_WITH_VDB"
[[noreturn]] void throw_built_without(const std::string& what, const std::string& library,
                                      const std::string& option);

}  // namespace conchoid
