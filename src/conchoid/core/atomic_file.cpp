#include "conchoid/core/atomic_file.hpp"

#include <fcntl.h>
#include <unistd.h>

#include <atomic>
#include <cerrno>
#include <cstring>
#include <string>
#include <system_error>

#include "conchoid/core/error.hpp"

namespace conchoid {
namespace {

std::filesystem::path temporary_name(const std::filesystem::path& path) {
  static std::atomic<unsigned> counter = 0;
  std::filesystem::path name = path;
  name += ".tmp-" + std::to_string(::getpid()) + "-" + std::to_string(counter++);
  return name;
}

/// Forces what was written to a file or folder onto the disk; false if that failed.
bool sync_to_disk(const std::filesystem::path& path) {
  const int descriptor = ::open(path.c_str(), O_RDONLY);
  if (descriptor < 0) return false;
  const bool done = ::fsync(descriptor) == 0;
  ::close(descriptor);
  return done;
}

WriteError writing_failed(const std::filesystem::path& path) {
  return WriteError(path.string() + ": writing failed (" + std::strerror(errno) + "); is the disk full?");
}

}  // namespace

AtomicFile::AtomicFile(std::filesystem::path path)
    : path_(std::move(path)), temporary_(temporary_name(path_)) {
  errno = 0;
  stream_.open(temporary_, std::ios::binary | std::ios::trunc);
  if (!stream_ && errno == ENOSPC) throw writing_failed(path_);
  if (!stream_)
    throw InputError(path_.string() + ": cannot be written (" + std::strerror(errno) +
                     "); name a file in an existing folder that you may write to");
}

AtomicFile::~AtomicFile() {
  if (temporary_.empty()) return;
  stream_.close();
  std::error_code ignored;
  std::filesystem::remove(temporary_, ignored);
}

void AtomicFile::commit() {
  stream_.close();
  if (!stream_ || !sync_to_disk(temporary_)) throw writing_failed(path_);
  std::error_code error;
  std::filesystem::rename(temporary_, path_, error);
  if (error)
    throw InputError(path_.string() + ": cannot be replaced (" + error.message() + "); is it a folder?");
  temporary_.clear();
  sync_to_disk(path_.has_parent_path() ? path_.parent_path() : std::filesystem::path("."));
}

}  // namespace conchoid
