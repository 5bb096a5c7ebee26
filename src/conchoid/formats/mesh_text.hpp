#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <string_view>

#include "conchoid/mesh/polygon_triangles.hpp"
#include "conchoid/mesh/tri_mesh.hpp"

namespace conchoid {

/// Walks through a text file line by line and word by word and knows where it is, for the readers of mesh
/// formats.
class TextScanner {
 public:
  TextScanner(std::string_view text, std::string file, std::size_t first_line = 1)
      : text_(text), file_(std::move(file)), line_(first_line - 1) {}

  /// A line whose last character before its comment is this one goes on in the next.
  void join_lines_after(char mark) { mark_ = mark; }
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
  void take_line();

  std::string_view text_, current_;
  std::string file_;
  std::size_t line_;
  char comment_ = '\0', mark_ = '\0';
  bool goes_on_ = false;  ///< the next line belongs to the current one
};

/// "FILE: message" as InputError.
[[noreturn]] void fail_in_file(const std::string& file, const std::string& message);

/// Appends the triangles of a polygon of nodes that the mesh has (polygon_triangles.hpp) and returns their
/// places in it. Nodes named twice running count once; two nodes and fewer give no triangle.
std::vector<PolygonTriangle> add_polygon(TriMesh& mesh, const std::vector<NodeId>& polygon);

/// Says once, when a file is read, what was left out of it because it bounds no area.
class SkippedElements {
 public:
  explicit SkippedElements(std::string file) : file_(std::move(file)) {}
  /// @param kind  in the plural: "faces of fewer than three vertices"
  void add(const std::string& kind) { ++counts_[kind]; }
  void warn() const;

 private:
  std::string file_;
  std::map<std::string, std::size_t> counts_;
};

}  // namespace conchoid
