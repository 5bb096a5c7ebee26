#include "conchoid/core/module.hpp"

#include <dlfcn.h>

#include "conchoid/core/error.hpp"

namespace conchoid {
namespace {

std::string last_error() {
  const char* text = dlerror();
  return text ? text : "no reason given";
}

}  // namespace

void* module_symbol(const Module& module, const char* symbol, const std::string& what) {
  const std::string file = std::string(module.name) + ".so";
  void* const handle = dlopen(file.c_str(), RTLD_NOW | RTLD_LOCAL);  // again and again the same one
  if (!handle)
    throw InputError(what + ": this conchoid was built without " + module.library +
                     ", or its module is not where it was (" + last_error() + "); rebuild it with -D" +
                     module.option + "=ON, or install " + module.library + " and name the folder of " + file +
                     " in LD_LIBRARY_PATH");
  const auto* version = static_cast<const char*>(dlsym(handle, "conchoid_module_version"));
  void* const found = dlsym(handle, symbol);
  if (!version || !found || std::string(version) != CONCHOID_VERSION)
    throw InputError(what + ": " + file + " belongs to another version of conchoid than " + CONCHOID_VERSION +
                     "; install program and modules together");
  return found;
}

}  // namespace conchoid
