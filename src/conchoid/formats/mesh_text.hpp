#pragma once

#include <cstdint>
#include <string>
#include <string_view>

#include "conchoid/mesh/tri_mesh.hpp"

namespace conchoid {

/// Walks through a text file line by line and word by word and knows where it is, for the readers of mesh
/// formats.
class TextScanner {
 public:
  TextScanner(std::string_view text, std::string file, std::size_t first_line = 1)
      : text_(text), file_(std::move(file)), line_(first_line - 1) {}

  /// Goes to the next line that has words; `comment` starts a comment that runs to the end of a line. False
  /// at the end.
  bool next_line(char comment = '\0');
  /// Next word of the current line, empty at its end.
  std::string_view next_word();
  /// Next word of the file, over line ends; fails at the end of the file.
  std::string_view next_word_across(char comment, const char* what);

  double number(std::string_view word, const char* what) const;
  std::int64_t integer(std::string_view word, const char* what) const;

  /// What is left of the file after the current line.
  std::string_view rest() const { return text_; }
  std::size_t line() const { return line_; }
  [[noreturn]] void fail(const std::string& message) const;

 private:
  std::string_view text_, current_;
  std::string file_;
  std::size_t line_;
};

/// "FILE: message" as InputError.
[[noreturn]] void fail_in_file(const std::string& file, const std::string& message);

/// Appends the triangles of a polygon, as a fan about its first corner.
void add_polygon(TriMesh& mesh, const std::vector<NodeId>& polygon);
/// Which corner of the polygon is corner k of the i-th triangle of its fan.
inline std::size_t polygon_corner(std::size_t i, int k) {
  return k == 0 ? 0 : i + static_cast<std::size_t>(k);
}

}  // namespace conchoid
