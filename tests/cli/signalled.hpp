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

/// Likewise, but asks `ready` whenever the program's first thread enters or leaves the kernel, and that thread
/// gets no further before it has the signal: however fast the machine, none of its files is written between
/// the two. A program that ends before `ready` returns its exit status.
int run_and_signal_at_once(const std::vector<std::string>& arguments, const TemporaryFolder& folder,
                           const std::function<bool()>& ready, int signal);

}  // namespace conchoid::test
