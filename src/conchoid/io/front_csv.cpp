#include <array>
#include <charconv>
#include <fstream>
#include <limits>
#include <string>
#include <string_view>

#include "conchoid/core/atomic_file.hpp"
#include "conchoid/core/error.hpp"
#include "conchoid/core/numbers.hpp"
#include "conchoid/io/run_folder.hpp"

namespace conchoid {
namespace {

struct Column {
  const char* name;
  double (*get)(const FrontRow&);
  void (*set)(FrontRow&, double);
};

template <int FrontRow::*member>
constexpr Column whole(const char* name) {
  return {name, [](const FrontRow& r) { return static_cast<double>(r.*member); },
          [](FrontRow& r, double v) { r.*member = static_cast<int>(v); }};
}
template <double FrontRow::*member>
constexpr Column real(const char* name) {
  return {name, [](const FrontRow& r) { return r.*member; }, [](FrontRow& r, double v) { r.*member = v; }};
}
template <Vec3 FrontRow::*member, int i>
constexpr Column component(const char* name) {
  return {name, [](const FrontRow& r) { return (r.*member)[i]; },
          [](FrontRow& r, double v) { (r.*member)[i] = v; }};
}

constexpr std::array<Column, 14> columns{whole<&FrontRow::frame>("frame"),
                                         whole<&FrontRow::front>("front"),
                                         whole<&FrontRow::node>("node"),
                                         component<&FrontRow::position, 0>("x"),
                                         component<&FrontRow::position, 1>("y"),
                                         component<&FrontRow::position, 2>("z"),
                                         component<&FrontRow::intensity, 0>("K_I"),
                                         component<&FrontRow::intensity, 1>("K_II"),
                                         component<&FrontRow::intensity, 2>("K_III"),
                                         component<&FrontRow::opening, 0>("opening_I"),
                                         component<&FrontRow::opening, 1>("opening_II"),
                                         component<&FrontRow::opening, 2>("opening_III"),
                                         real<&FrontRow::speed>("speed"),
                                         real<&FrontRow::kink_angle>("kink_angle")};

std::vector<std::string_view> split(std::string_view line) {
  if (!line.empty() && line.back() == '\r') line.remove_suffix(1);
  std::vector<std::string_view> cells;
  for (;;) {
    const std::size_t comma = line.find(',');
    cells.push_back(line.substr(0, comma));
    if (comma == std::string_view::npos) return cells;
    line.remove_prefix(comma + 1);
  }
}

}  // namespace

void write_front_csv(const std::filesystem::path& path, const std::vector<FrontRow>& rows) {
  AtomicFile file(path);
  std::ostream& out = file.stream();
  for (std::size_t c = 0; c < columns.size(); ++c)
    out << (c ? "," : "") << columns[c].name;
  out << '\n';
  for (const FrontRow& row : rows) {
    for (std::size_t c = 0; c < columns.size(); ++c)
      out << (c ? "," : "") << shortest(columns[c].get(row));
    out << '\n';
  }
  file.commit();
}

std::vector<FrontRow> read_front_csv(const std::filesystem::path& path) {
  std::ifstream in(path, std::ios::binary);
  if (!in) throw InputError(path.string() + ": cannot be opened; check the name and the permissions");
  std::string line;
  std::getline(in, line);
  const std::string head = line;
  std::vector<const Column*> meaning;
  std::array<bool, columns.size()> found{};
  for (std::string_view name : split(head)) {
    meaning.push_back(nullptr);
    for (std::size_t c = 0; c < columns.size(); ++c)
      if (name == columns[c].name) {
        meaning.back() = &columns[c];
        found[c] = true;
      }
  }
  for (std::size_t c = 0; c < columns.size(); ++c)
    if (!found[c])
      throw InputError(
          path.string() + ": line 1: the column '" + columns[c].name +
          "' is missing; this is not a front.csv, or it was edited: run the scene again with --out");

  std::vector<FrontRow> rows;
  for (int number = 2; std::getline(in, line); ++number) {
    const auto refuse = [&](const std::string& what) {
      throw InputError(path.string() + ": line " + std::to_string(number) + ": " + what +
                       "; run the scene again with --out");
    };
    const std::vector<std::string_view> cells = split(line);
    if (cells.size() != meaning.size())
      refuse(std::to_string(cells.size()) + " cells where the header has " + std::to_string(meaning.size()));
    FrontRow row;
    for (std::size_t c = 0; c < cells.size(); ++c) {
      if (!meaning[c]) continue;
      double value = 0;
      const auto [end, error] = std::from_chars(cells[c].data(), cells[c].data() + cells[c].size(), value);
      if (error != std::errc() || end != cells[c].data() + cells[c].size())
        refuse(std::string(cells[c]) + " is not a number");
      meaning[c]->set(row, value);
    }
    rows.push_back(row);
  }
  return rows;
}

}  // namespace conchoid
