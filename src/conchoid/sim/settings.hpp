#pragma once

#include <limits>
#include <string>
#include <string_view>
#include <vector>

namespace conchoid {

enum class SettingType { number, integer, boolean, text, file, numbers, components, vectors, texts };

/// Allowed values of a number: low … high, each end included or not.
struct SettingRange {
  double low = -std::numeric_limits<double>::infinity();
  double high = std::numeric_limits<double>::infinity();
  bool low_included = true, high_included = true;

  bool contains(double x) const;
  /// "> 0", "1 … 11", "> −1 and < 0.5"; empty if everything is allowed.
  std::string text() const;
};

/// One key of a scene or database specification. This table is the only place where keys, units, ranges and
/// defaults are written down: the parser obeys it, `--help` and docs/scene.md print it.
struct Setting {
  std::string_view table;  ///< as in SettingTable::name
  std::string_view key;
  SettingType type;
  std::string_view unit;      ///< "Pa", "m", …; empty: none
  std::string_view standard;  ///< default as TOML text; empty: none
  std::string_view help;
  SettingRange range = {};
  std::size_t length = 0;  ///< numbers: how many; vectors: numbers in each; texts: how many, 0: any
  std::vector<std::string_view> choices = {};  ///< text, texts: allowed values; empty: any
};

/// One table of the file: [name], or [[name]] when it may be repeated.
struct SettingTable {
  std::string_view name;
  bool repeated;
  bool in_scene;  ///< false: only in the specification of a database
  std::string_view help;
  std::string_view keys_of = {};  ///< the table whose keys it has; empty: its own
};

const std::vector<SettingTable>& setting_tables();
const std::vector<Setting>& settings();
/// The table that lists the keys of a table: mostly itself.
std::string_view table_of_keys(std::string_view table);
/// The setting, or nullptr.
const Setting* find_setting(std::string_view table, std::string_view key);

/// All keys as plain text, for `--help`.
std::string settings_text(bool database);
/// All keys as Markdown tables, for docs/scene.md.
std::string settings_markdown();

/// The candidate most like `word` (fewest insertions, deletions and changes), or an empty text if none is
/// like it.
std::string nearest_name(std::string_view word, const std::vector<std::string_view>& candidates);

}  // namespace conchoid
