#pragma once

#include <string>

namespace conchoid {

/// A part of the library in a shared object of its own, loaded on first use: what it is linked with takes longer to load
/// than many a run takes. It is looked for where the program looks for shared objects (its run path: `modules` of the
/// build folder, `lib/conchoid` of an installation; then LD_LIBRARY_PATH), and stays loaded.
///
/// A module has its own copy of what it takes from the rooms: it holds no state and starts no parallel loops of ours.
struct Module {
  const char* name;     ///< of the file, without ".so"
  const char* library;  ///< what it is there for, as a user knows it: "OpenVDB"
  const char* option;   ///< the switch that builds it: "CONCHOID_WITH_VDB"
};

/// The address of a function of a module. May be called from several threads.
/// Throws InputError that begins with `what`, says why there is no such module and what to do.
void* module_symbol(const Module& module, const char* symbol, const std::string& what);

template <class Function>
Function* module_function(const Module& module, const char* symbol, const std::string& what) {
  return reinterpret_cast<Function*>(module_symbol(module, symbol, what));
}

}  // namespace conchoid

/// Stands before what module_symbol() finds in a module.
#define CONCHOID_MODULE_FUNCTION extern "C" __attribute__((visibility("default")))
