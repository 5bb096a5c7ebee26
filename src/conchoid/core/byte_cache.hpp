#pragma once

#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <string_view>

namespace conchoid {

/// Bytes as they lie in a file that is mapped into memory: what nobody looks at is not read. They stay as long as `owner` does, whatever
/// becomes of the file's name.
struct KeptBytes {
  std::shared_ptr<const void> owner;
  std::string_view bytes;  ///< begin at a multiple of 64
};

/// What is costly to make, kept in a folder under a name that tells what it was made from (cache_name()). Every entry
/// is a file of its own, with version, name, length and checksum in front. Files appear whole or not at all, so any
/// number of programs may share a folder; deleting files, or all of it, does no harm.
class ByteCache {
 public:
  /// Makes the folder if it is not there. Throws InputError where that cannot be done.
  explicit ByteCache(std::filesystem::path folder);

  /// What was kept under a name. Nothing, with a warning, for a file that is damaged or not one of these.
  std::optional<KeptBytes> recall(const std::string& name) const;
  /// A disk that is full, or a folder that cannot be written to, is a warning.
  void keep(const std::string& name, std::string_view bytes) const;

 private:
  std::filesystem::path file_of(const std::string& name) const;
  std::filesystem::path folder_;
};

/// Name for what is made by this version of the program on a processor of this kind from these bytes: 128 bits of
/// their hash behind `kind`.
std::string cache_name(const std::string& kind, std::string_view made_from);

}  // namespace conchoid
