#pragma once

#include <filesystem>
#include <fstream>

namespace conchoid {

/// A file that appears complete or not at all: written beside its final place under a temporary name, moved
/// there by commit(). Without commit() the temporary file is removed and whatever was at the final place
/// stays. Throws InputError where the folder cannot be written to and ComputationError where writing fails
/// (full disk).
class AtomicFile {
 public:
  explicit AtomicFile(std::filesystem::path path);
  ~AtomicFile();
  AtomicFile(const AtomicFile&) = delete;
  AtomicFile& operator=(const AtomicFile&) = delete;

  std::ostream& stream() { return stream_; }
  /// Flushes to the disk and moves the file to its final place.
  void commit();

 private:
  std::filesystem::path path_, temporary_;
  std::ofstream stream_;
};

}  // namespace conchoid
