#include "conchoid/formats/mesh_text.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>

#include "conchoid/core/error.hpp"
#include "conchoid/core/interrupt.hpp"
#include "conchoid/core/log.hpp"

namespace conchoid {
namespace {

constexpr std::string_view blanks = " \t\r\v\f";

/// The word as it may stand in a message: short and printable.
std::string quoted(std::string_view word) {
  std::string text = "'";
  for (char c : word.substr(0, 24))
    text += c >= 32 && c < 127 ? c : '?';
  return text + (word.size() > 24 ? "…'" : "'");
}

}  // namespace

void TextScanner::take_line() {
  throw_if_interrupted();
  const std::size_t end = text_.find('\n');
  current_ = text_.substr(0, end);
  text_ = end == std::string_view::npos ? std::string_view() : text_.substr(end + 1);
  ++line_;
  if (comment_ != '\0') current_ = current_.substr(0, current_.find(comment_));
  const std::size_t last = current_.find_last_not_of(blanks);
  goes_on_ = mark_ != '\0' && last != std::string_view::npos && current_[last] == mark_;
  if (goes_on_) current_ = current_.substr(0, last);
}

bool TextScanner::next_line(char comment) {
  comment_ = comment;
  while (goes_on_ && !text_.empty())
    take_line();
  while (!text_.empty()) {
    take_line();
    while (goes_on_ && current_.find_first_not_of(blanks) == std::string_view::npos && !text_.empty())
      take_line();
    if (current_.find_first_not_of(blanks) != std::string_view::npos) return true;
  }
  current_ = {};
  return false;
}

std::string_view TextScanner::next_word() {
  std::size_t begin = current_.find_first_not_of(blanks);
  while (begin == std::string_view::npos && goes_on_ && !text_.empty()) {
    take_line();
    begin = current_.find_first_not_of(blanks);
  }
  if (begin == std::string_view::npos) {
    current_ = {};
    return {};
  }
  const std::size_t end = std::min(current_.find_first_of(blanks, begin), current_.size());
  const std::string_view word = current_.substr(begin, end - begin);
  current_ = current_.substr(end);
  return word;
}

std::string_view TextScanner::next_word_across(char comment, const char* what) {
  while (true) {
    if (const std::string_view word = next_word(); !word.empty()) return word;
    if (!next_line(comment)) fail(std::string("the file ends where ") + what + " should be; it is truncated");
  }
}

double TextScanner::number(std::string_view word, const char* what) const {
  std::string_view digits = word;
  if (digits.size() > 1 && digits[0] == '+' && digits[1] != '-') digits.remove_prefix(1);
  double value = 0;
  const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), value);
  if (word.empty()) fail(std::string(what) + " is missing");
  if (error == std::errc::result_out_of_range)
    fail(std::string(what) + " " + quoted(word) + " is too large or too small a number");
  if (error != std::errc() || end != digits.data() + digits.size())
    fail(std::string(what) + " " + quoted(word) + " is not a number");
  if (!std::isfinite(value))
    fail(std::string(what) + " " + quoted(word) + " is not finite; repair the coordinates");
  return value;
}

std::int64_t TextScanner::integer(std::string_view word, const char* what) const {
  std::int64_t value = 0;
  const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
  if (word.empty()) fail(std::string(what) + " is missing");
  if (error != std::errc() || end != word.data() + word.size())
    fail(std::string(what) + " " + quoted(word) + " is not a whole number");
  return value;
}

void TextScanner::fail(const std::string& message) const {
  fail_in_file(file_, "line " + std::to_string(line_) + ": " + message);
}

void fail_in_file(const std::string& file, const std::string& message) {
  throw InputError(file + ": " + message);
}

std::vector<PolygonTriangle> add_polygon(TriMesh& mesh, const std::vector<NodeId>& polygon) {
  std::vector<NodeId> nodes;
  std::vector<std::size_t> place;
  for (std::size_t k = 0; k < polygon.size(); ++k)
    if (polygon.size() <= 3 || polygon[k] != polygon[(k + 1) % polygon.size()]) {
      nodes.push_back(polygon[k]);
      place.push_back(k);
    }
  std::vector<PolygonTriangle> triangles = polygon_triangles(mesh.positions, nodes);
  for (PolygonTriangle& t : triangles) {
    for (std::size_t& k : t)
      k = place[k];
    mesh.corners.push_back({polygon[t[0]], polygon[t[1]], polygon[t[2]]});
  }
  return triangles;
}

void SkippedElements::warn() const {
  std::string text;
  for (const auto& [kind, count] : counts_)
    text += (text.empty() ? "" : ", ") + std::to_string(count) + " " + kind;
  if (!text.empty()) warning(file_ + ": skipped " + text + "; they bound no area");
}

}  // namespace conchoid
