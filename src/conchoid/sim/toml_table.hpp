#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "conchoid/core/vec.hpp"

namespace conchoid {

/// One table of a TOML file, read by the rules of the settings table (settings.hpp): every value that comes
/// out is of the right type, finite and in its range. Every error is an InputError "file:line: what, remedy".
class TomlTable {
 public:
  /// The whole file. @param name  of the file, for messages
  static TomlTable parse(std::string_view text, const std::string& name);
  ~TomlTable();
  TomlTable(const TomlTable&);
  TomlTable& operator=(const TomlTable&);

  /// Throws for a key that the settings table does not list here, naming the one most like it.
  /// @param database  whether tables of a database specification are allowed (asked of the whole file only)
  void require_known_keys(bool database = false) const;

  bool has(std::string_view key) const;
  /// The table [key] in this one, if it is there.
  std::optional<TomlTable> table(std::string_view key) const;
  /// The tables [[key]] in this one.
  std::vector<TomlTable> tables(std::string_view key) const;
  /// [key] or the tables [[key]], whichever is there.
  std::vector<TomlTable> one_or_more(std::string_view key) const;

  // Each leaves `value` as it is where the key is missing.
  void read(std::string_view key, double& value) const;
  void read(std::string_view key, int& value) const;
  void read(std::string_view key, std::uint64_t& value) const;
  void read(std::string_view key, bool& value) const;
  void read(std::string_view key, std::string& value) const;
  void read(std::string_view key, Vec3& value) const;
  /// Components that are "free" come out as none.
  void read(std::string_view key, std::array<std::optional<double>, 3>& value) const;
  void read(std::string_view key, std::vector<double>& value) const;
  void read(std::string_view key, std::vector<std::vector<double>>& value) const;
  void read(std::string_view key, std::vector<std::string>& value) const;
  /// Like read(), but a missing key is an error.
  template <class T>
  void require(std::string_view key, T& value) const {
    require_key(key);
    read(key, value);
  }

  /// "file:line" of the key, or of the table where the key is missing or empty.
  std::string where(std::string_view key = {}) const;
  /// InputError at that place.
  [[noreturn]] void fail(std::string_view key, const std::string& what) const;

 private:
  struct Content;
  explicit TomlTable(std::shared_ptr<const Content> content);
  void require_key(std::string_view key) const;
  void require_choice(std::string_view key, const std::string& text) const;
  std::shared_ptr<const Content> content_;
};

}  // namespace conchoid
