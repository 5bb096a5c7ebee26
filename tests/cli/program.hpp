#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "temporary_folder.hpp"

namespace conchoid::test {

/// What a call of the real program did.
struct Outcome {
  int status = -1;  ///< exit status; 128 + signal if a signal ended it
  std::string out, err;
};

/// Runs any program with its arguments in a working folder.
Outcome run_command(const std::vector<std::string>& words, const std::filesystem::path& folder);
/// Runs ours.
Outcome run_program(const std::vector<std::string>& arguments, const std::filesystem::path& folder);

/// All files below a folder.
std::vector<std::filesystem::path> files_below(const std::filesystem::path& folder);

}  // namespace conchoid::test
