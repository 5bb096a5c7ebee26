#include "conchoid/study/experiments/report.hpp"

#include <fmt/format.h>

#include <cmath>

namespace conchoid {
namespace {

std::string csv_cell(const std::string& text) {
  if (text.find_first_of(",\"\n") == std::string::npos) return text;
  std::string quoted;
  for (const char c : text) {
    if (c == '"') quoted += c;
    quoted += c;
  }
  return fmt::format("\"{}\"", quoted);
}

std::string csv_line(const std::vector<std::string>& cells) {
  std::vector<std::string> quoted;
  for (const std::string& cell : cells)
    quoted.push_back(csv_cell(cell));
  return fmt::format("{}\n", fmt::join(quoted, ","));
}

}  // namespace

std::string csv_text(const ReportTable& table) {
  std::string text = csv_line(table.columns);
  for (const auto& row : table.rows)
    text += csv_line(row);
  return text;
}

std::string percent_text(double share) {
  return std::isfinite(share) ? fmt::format("{:.2f} %", 100 * share) : "–";
}

std::string number_text(double value) {
  return std::isfinite(value) ? fmt::format("{:.3g}", value) : "–";
}

}  // namespace conchoid
