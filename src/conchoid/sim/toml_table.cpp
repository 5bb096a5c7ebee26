#include "conchoid/sim/toml_table.hpp"

#include <fmt/format.h>
#include <toml++/toml.h>

#include <algorithm>
#include <cmath>

#include "conchoid/core/error.hpp"
#include "conchoid/sim/settings.hpp"

namespace conchoid {

struct TomlTable::Content {
  std::shared_ptr<const toml::table> document;
  const toml::table* table;
  std::string file;
  std::string name;  ///< path of the table, empty for the whole file

  std::string path(std::string_view key) const {
    return name.empty() ? std::string(key) : name + "." + std::string(key);
  }
  /// The setting that describes a key; asking for one that is not listed is a mistake in this program.
  const Setting& setting(std::string_view key) const {
    const Setting* found = find_setting(name, key);
    if (!found) throw std::logic_error("no setting " + path(key));
    return *found;
  }
};

namespace {

std::string_view type_text(const toml::node& node) {
  switch (node.type()) {
    case toml::node_type::table:
      return "a table";
    case toml::node_type::array:
      return "a list";
    case toml::node_type::string:
      return "a text";
    case toml::node_type::integer:
      return "a whole number";
    case toml::node_type::floating_point:
      return "a number";
    case toml::node_type::boolean:
      return "true or false";
    default:
      return "a date";
  }
}

}  // namespace

TomlTable::TomlTable(std::shared_ptr<const Content> content) : content_(std::move(content)) {}
TomlTable::~TomlTable() = default;
TomlTable::TomlTable(const TomlTable&) = default;
TomlTable& TomlTable::operator=(const TomlTable&) = default;

TomlTable TomlTable::parse(std::string_view text, const std::string& name) {
  try {
    auto document = std::make_shared<const toml::table>(toml::parse(text, name));
    return TomlTable(std::make_shared<const Content>(Content{document, document.get(), name, ""}));
  } catch (const toml::parse_error& error) {
    throw InputError(fmt::format("{}:{}: not valid TOML: {}; correct this line", name,
                                 error.source().begin.line, error.description()));
  }
}

std::string TomlTable::where(std::string_view key) const {
  const toml::node* node = key.empty() ? nullptr : content_->table->get(key);
  const auto& source = node ? node->source() : content_->table->source();
  return fmt::format("{}:{}", content_->file, std::max<unsigned>(1, source.begin.line));
}

void TomlTable::fail(std::string_view key, const std::string& what) const {
  throw InputError(where(key) + ": " + what);
}

void TomlTable::require_known_keys(bool database) const {
  std::vector<std::string_view> known;
  for (const Setting& s : settings())
    if (s.table == table_of_keys(content_->name)) known.push_back(s.key);
  for (const SettingTable& t : setting_tables()) {
    const std::size_t dot = t.name.rfind('.');
    const bool nested = dot != std::string_view::npos;
    const std::string_view parent = nested ? t.name.substr(0, dot) : std::string_view{};
    if (parent == content_->name && (t.in_scene || database))
      known.push_back(nested ? t.name.substr(dot + 1) : t.name);
  }
  for (const auto& [key, node] : *content_->table) {
    if (std::find(known.begin(), known.end(), key.str()) != known.end()) continue;
    const std::string place = content_->name.empty() ? "table" : "key in [" + content_->name + "]";
    const std::string like = nearest_name(key.str(), known);
    fail(key.str(), fmt::format("unknown {}: {}; {}", place, key.str(),
                                like.empty() ? fmt::format("known are {}", fmt::join(known, ", "))
                                             : fmt::format("did you mean {}?", like)));
  }
}

bool TomlTable::has(std::string_view key) const {
  return content_->table->contains(key);
}

std::optional<TomlTable> TomlTable::table(std::string_view key) const {
  const toml::node* node = content_->table->get(key);
  if (!node) return std::nullopt;
  if (!node->is_table())
    fail(key, fmt::format("{0} is {1}, but must be one table; write [{0}]", content_->path(key),
                          type_text(*node)));
  return TomlTable(std::make_shared<const Content>(
      Content{content_->document, node->as_table(), content_->file, content_->path(key)}));
}

std::vector<TomlTable> TomlTable::tables(std::string_view key) const {
  std::vector<TomlTable> result;
  const toml::node* node = content_->table->get(key);
  if (!node) return result;
  const toml::array* array = node->as_array();
  if (!array || !array->is_homogeneous(toml::node_type::table))
    fail(key, fmt::format("{0} is {1}, but must be a list of tables; write [[{0}]]", content_->path(key),
                          type_text(*node)));
  for (const toml::node& element : *array)
    result.push_back(TomlTable(std::make_shared<const Content>(
        Content{content_->document, element.as_table(), content_->file, content_->path(key)})));
  return result;
}

std::vector<TomlTable> TomlTable::one_or_more(std::string_view key) const {
  const toml::node* node = content_->table->get(key);
  if (!node || !node->is_table()) return tables(key);
  return {*table(key)};
}

void TomlTable::require_key(std::string_view key) const {
  if (has(key)) return;
  const Setting& s = content_->setting(key);
  fail({}, fmt::format("[{}] lacks {} ({}{}{}); add it", content_->name, key, s.help,
                       s.unit.empty() ? "" : ", ", s.unit));
}

void TomlTable::read(std::string_view key, double& value) const {
  const Setting& s = content_->setting(key);
  const toml::node* node = content_->table->get(key);
  if (!node) return;
  if (!node->is_number())
    fail(key, fmt::format("{} is {}, but must be a number{}{}", content_->path(key), type_text(*node),
                          s.unit.empty() ? "" : " in ", s.unit));
  const double x = *node->value<double>();
  if (!std::isfinite(x))
    fail(key, fmt::format("{} is {}, but must be a finite number", content_->path(key), x));
  if (!s.range.contains(x))
    fail(key, fmt::format("{} is {}, but must be {}{}{}", content_->path(key), x, s.range.text(),
                          s.unit.empty() ? "" : " ", s.unit));
  value = x;
}

void TomlTable::read(std::string_view key, std::uint64_t& value) const {
  const Setting& s = content_->setting(key);
  const toml::node* node = content_->table->get(key);
  if (!node) return;
  if (!node->is_integer())
    fail(key, fmt::format("{} is {}, but must be a whole number", content_->path(key), type_text(*node)));
  const std::int64_t n = *node->value<std::int64_t>();
  if (!s.range.contains(static_cast<double>(n)))
    fail(key, fmt::format("{} is {}, but must be {}", content_->path(key), n, s.range.text()));
  value = static_cast<std::uint64_t>(n);
}

void TomlTable::read(std::string_view key, int& value) const {
  std::uint64_t n = static_cast<std::uint64_t>(value);
  read(key, n);
  value = static_cast<int>(n);
}

void TomlTable::read(std::string_view key, bool& value) const {
  const toml::node* node = content_->table->get(key);
  if (!node) return;
  if (!node->is_boolean())
    fail(key, fmt::format("{} is {}, but must be true or false, without quotes", content_->path(key),
                          type_text(*node)));
  value = *node->value<bool>();
}

void TomlTable::require_choice(std::string_view key, const std::string& text) const {
  const Setting& s = content_->setting(key);
  if (s.choices.empty() || std::find(s.choices.begin(), s.choices.end(), text) != s.choices.end()) return;
  const std::string like = nearest_name(text, s.choices);
  fail(key, fmt::format("{} = \"{}\" does not exist; {}choose from \"{}\"", content_->path(key), text,
                        like.empty() ? "" : fmt::format("did you mean \"{}\"? Otherwise ", like),
                        fmt::join(s.choices, "\", \"")));
}

void TomlTable::read(std::string_view key, std::string& value) const {
  const Setting& s = content_->setting(key);
  const toml::node* node = content_->table->get(key);
  if (!node) return;
  if (!node->is_string())
    fail(key, fmt::format("{} is {}, but must be a text in quotes", content_->path(key), type_text(*node)));
  const std::string text = *node->value<std::string>();
  if (text.empty())
    fail(key, fmt::format("{} is empty; give a {}", content_->path(key),
                          s.type == SettingType::file ? "file name" : "name"));
  require_choice(key, text);
  value = text;
}

void TomlTable::read(std::string_view key, std::vector<double>& value) const {
  const Setting& s = content_->setting(key);
  const toml::node* node = content_->table->get(key);
  if (!node) return;
  const toml::array* array = node->as_array();
  if (!array || array->size() != s.length)
    fail(key, fmt::format("{} is {}, but must be a list of {} numbers", content_->path(key),
                          array ? fmt::format("a list of {}", array->size()) : std::string(type_text(*node)),
                          s.length));
  std::vector<double> numbers;
  for (const toml::node& element : *array) {
    const std::optional<double> x = element.is_number() ? element.value<double>() : std::nullopt;
    if (!x || !std::isfinite(*x))
      fail(key, fmt::format("{} must hold {} finite numbers", content_->path(key), s.length));
    if (!s.range.contains(*x))
      fail(key, fmt::format("{} holds {}, but its numbers must be {}{}{}", content_->path(key), *x,
                            s.range.text(), s.unit.empty() ? "" : " ", s.unit));
    numbers.push_back(*x);
  }
  value = numbers;
}

void TomlTable::read(std::string_view key, std::array<std::optional<double>, 3>& value) const {
  const toml::node* node = content_->table->get(key);
  if (!node) return;
  const toml::array* array = node->as_array();
  const auto refuse = [&] {
    fail(key,
         fmt::format("{} must be a list of 3 finite numbers, \"free\" where a component is not prescribed",
                     content_->path(key)));
  };
  if (!array || array->size() != 3) refuse();
  for (std::size_t k = 0; k < 3; ++k) {
    const toml::node& element = (*array)[k];
    value[k] = element.is_number() ? element.value<double>() : std::nullopt;
    if (value[k] ? !std::isfinite(*value[k]) : element.value<std::string>() != "free") refuse();
  }
}

void TomlTable::read(std::string_view key, Vec3& value) const {
  std::vector<double> numbers(value.data(), value.data() + 3);
  read(key, numbers);
  value = Vec3(numbers[0], numbers[1], numbers[2]);
}

void TomlTable::read(std::string_view key, std::vector<std::vector<double>>& value) const {
  const Setting& s = content_->setting(key);
  const toml::node* node = content_->table->get(key);
  if (!node) return;
  const std::string wanted = fmt::format("{} must be a list of lists of {} finite numbers each, [[…], …]",
                                         content_->path(key), s.length);
  const toml::array* rows = node->as_array();
  if (!rows || rows->empty()) fail(key, wanted);
  std::vector<std::vector<double>> result;
  for (const toml::node& row : *rows) {
    const toml::array* columns = row.as_array();
    if (!columns || columns->size() != s.length) fail(key, wanted);
    std::vector<double>& numbers = result.emplace_back();
    for (const toml::node& element : *columns) {
      const std::optional<double> x = element.is_number() ? element.value<double>() : std::nullopt;
      if (!x || !std::isfinite(*x)) fail(key, wanted);
      numbers.push_back(*x);
    }
  }
  value = result;
}

void TomlTable::read(std::string_view key, std::vector<std::string>& value) const {
  const Setting& s = content_->setting(key);
  const toml::node* node = content_->table->get(key);
  if (!node) return;
  const toml::array* array = node->as_array();
  if (!array || (s.length > 0 && array->size() != s.length) ||
      (!array->empty() && !array->is_homogeneous(toml::node_type::string)))
    fail(key, fmt::format("{} must be a list of {}texts in quotes", content_->path(key),
                          s.length > 0 ? fmt::format("{} ", s.length) : ""));
  std::vector<std::string> texts;
  for (const toml::node& element : *array) {
    texts.push_back(*element.value<std::string>());
    require_choice(key, texts.back());
  }
  value = texts;
}

}  // namespace conchoid
