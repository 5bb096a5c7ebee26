#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace conchoid::test {

/// What a call of the real program did.
struct Outcome {
  int status = -1;  ///< exit status; 128 + signal if a signal ended it
  std::string out, err;
};

/// Runs the program with these arguments in a working folder.
Outcome run_program(const std::vector<std::string>& arguments, const std::filesystem::path& folder);

/// A folder of one test, removed with everything in it at the end.
class TemporaryFolder {
 public:
  TemporaryFolder();
  ~TemporaryFolder();
  TemporaryFolder(const TemporaryFolder&) = delete;
  TemporaryFolder& operator=(const TemporaryFolder&) = delete;

  const std::filesystem::path& path() const { return path_; }
  std::filesystem::path operator/(const std::string& name) const { return path_ / name; }
  void write(const std::string& name, const std::string& content) const;
  std::string read(const std::string& name) const;

 private:
  std::filesystem::path path_;
};

/// All files below a folder.
std::vector<std::filesystem::path> files_below(const std::filesystem::path& folder);

}  // namespace conchoid::test
