#pragma once

#include <functional>

namespace conchoid {

/// Calls work() in a context of its own with the threads and the sink of the current one, which nobody has asked
/// to stop: to finish something small after a stop was asked for, such as writing what there is.
void undisturbed(const std::function<void()>& work);

}  // namespace conchoid
