#pragma once

#include <functional>
#include <string>
#include <vector>

#include "cli/program.hpp"

namespace conchoid::test {

/// Starts the program in a folder, waits until `ready` says so (at most a minute), then sends it a signal.
/// Returns its exit status, or 128 + the signal that ended it.
int run_and_signal(const std::vector<std::string>& arguments, const TemporaryFolder& folder,
                   const std::function<bool()>& ready, int signal);

}  // namespace conchoid::test
