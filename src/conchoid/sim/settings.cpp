#include "conchoid/sim/settings.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace conchoid {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

std::string_view type_name(const Setting& s) {
  switch (s.type) {
    case SettingType::number:
      return "number";
    case SettingType::integer:
      return "whole number";
    case SettingType::boolean:
      return "true or false";
    case SettingType::text:
      return "text";
    case SettingType::file:
      return "file";
    case SettingType::numbers:
      return "numbers";
    case SettingType::components:
      return "numbers or \"free\"";
    case SettingType::vectors:
      return "list of numbers";
    case SettingType::texts:
      return "texts";
  }
  return "";
}

/// "3 numbers, Pa, > 0".
std::string value_text(const Setting& s) {
  std::string text;
  if (s.type == SettingType::vectors)
    text = s.length ? fmt::format("lists of {} numbers", s.length) : "lists of numbers";
  else if (s.type == SettingType::texts && !s.choices.empty())
    text = fmt::format("list of \"{}\"", fmt::join(s.choices, "\", \""));
  else if (s.length)
    text = fmt::format("{} {}", s.length, type_name(s));
  else if (s.choices.empty())
    text = type_name(s);
  if (!s.choices.empty() && s.type == SettingType::text)
    text = fmt::format("\"{}\"", fmt::join(s.choices, "\", \""));
  if (!s.unit.empty()) text += fmt::format(", {}", s.unit);
  if (const std::string range = s.range.text(); !range.empty()) text += ", " + range;
  return text;
}

std::string heading(const SettingTable& table) {
  return fmt::format(fmt::runtime(table.repeated ? "[[{}]]" : "[{}]"), table.name);
}

std::size_t edit_distance(std::string_view a, std::string_view b) {
  std::vector<std::size_t> row(b.size() + 1);
  for (std::size_t j = 0; j <= b.size(); ++j)
    row[j] = j;
  for (std::size_t i = 1; i <= a.size(); ++i) {
    std::size_t diagonal = row[0];
    row[0] = i;
    for (std::size_t j = 1; j <= b.size(); ++j) {
      const std::size_t change = diagonal + (a[i - 1] == b[j - 1] ? 0 : 1);
      diagonal = row[j];
      row[j] = std::min({change, row[j] + 1, row[j - 1] + 1});
    }
  }
  return row.back();
}

}  // namespace

bool SettingRange::contains(double x) const {
  return (low_included ? x >= low : x > low) && (high_included ? x <= high : x < high);
}

std::string SettingRange::text() const {
  const bool has_low = low > -kInfinity, has_high = high < kInfinity;
  if (has_low && has_high && low_included && high_included) return fmt::format("{:g} … {:g}", low, high);
  std::string text;
  if (has_low) text = fmt::format("{} {:g}", low_included ? "≥" : ">", low);
  if (has_low && has_high) text += " and ";
  if (has_high) text += fmt::format("{} {:g}", high_included ? "≤" : "<", high);
  return text;
}

std::string_view table_of_keys(std::string_view table) {
  for (const SettingTable& t : setting_tables())
    if (t.name == table && !t.keys_of.empty()) return t.keys_of;
  return table;
}

const Setting* find_setting(std::string_view table, std::string_view key) {
  const auto& all = settings();
  table = table_of_keys(table);
  const auto found = std::find_if(all.begin(), all.end(),
                                  [&](const Setting& s) { return s.table == table && s.key == key; });
  return found == all.end() ? nullptr : &*found;
}

std::string settings_text(bool database) {
  std::string text =
      database ? "Keys of a database specification (the keys of a scene but [run] frames, and [database]):\n"
               : "Keys of a scene:\n";
  for (const SettingTable& table : setting_tables()) {
    if (!table.in_scene && !database) continue;
    text += fmt::format("\n{}\n", heading(table));
    if (!table.keys_of.empty()) text += fmt::format("  the keys of {}\n", table.keys_of);
    for (const Setting& s : settings()) {
      if (s.table != table.name) continue;
      text += fmt::format("  {} ({})", s.key, value_text(s));
      if (!s.standard.empty()) text += fmt::format(" = {}", s.standard);
      text += fmt::format("\n      {}\n", s.help);
    }
  }
  return text;
}

std::string settings_markdown() {
  std::string text;
  for (const SettingTable& table : setting_tables()) {
    text += fmt::format("\n### `{}`\n\n{}\n", heading(table), table.help);
    if (!table.keys_of.empty()) {
      text += fmt::format("\nThe keys are those of `{}`.\n", table.keys_of);
      continue;
    }
    text += "\n| key | value | default | meaning |\n|---|---|---|---|\n";
    for (const Setting& s : settings())
      if (s.table == table.name)
        text += fmt::format("| `{}` | {} | {} | {} |\n", s.key, value_text(s),
                            s.standard.empty() ? "" : fmt::format("`{}`", s.standard), s.help);
  }
  return text;
}

std::string nearest_name(std::string_view word, const std::vector<std::string_view>& candidates) {
  std::string_view best;
  std::size_t least = std::max<std::size_t>(2, word.size() / 3) + 1;
  for (std::string_view candidate : candidates) {
    const std::size_t distance = edit_distance(word, candidate);
    if (distance < least) {
      least = distance;
      best = candidate;
    }
  }
  return std::string(best);
}

}  // namespace conchoid
