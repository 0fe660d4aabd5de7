#include "scenes/parameter_table.h"

#include <toml++/toml.h>
#include <algorithm>
#include <cctype>
#include <utility>

#include "core/error.h"
#include "core/text.h"
#include "scenes/format/csv_reader.h"
#include "scenes/format/table_reader.h"
#include "scenes/scene_toml.h"

namespace pbmpi::scenes {
namespace {

/// An unquoted word is a text, unless it is a TOML value: true, false, inf, nan.
std::string value_of_cell(const std::string& cell) {
  constexpr const char* of_their_own[] = {"true", "false", "inf", "nan"};
  const bool begins_as_word =
      !cell.empty() && (std::isalpha(static_cast<unsigned char>(cell.front())) != 0 || cell.front() == '_');
  return begins_as_word && std::ranges::find(of_their_own, cell) == std::end(of_their_own) ? toml_string(cell)
                                                                                           : cell;
}

/// Adds the values of a [[world]] table and of its sub-tables, with dotted keys.
void flatten(const toml::table& table, const std::string& before, Overrides& overrides) {
  for (const auto& [key, node] : table) {
    const std::string name = before + std::string(key.str());
    if (const toml::table* inner = node.as_table(); inner && !inner->empty()) {
      flatten(*inner, name + ".", overrides);
    } else {
      overrides.push_back({name, toml_text(node), to_string(node.source()) + ": " + core::in_quotes(name)});
    }
  }
}

}  // namespace

ParameterTable::ParameterTable(std::string file, std::string text)
    : file_(std::move(file)), text_(std::move(text)) {
  file_.ends_with(".toml") ? read_toml_rows() : read_csv_rows();
  core::require_input(!rows_.empty(), file_ + ": the table has no worlds; give each of them a row");
  core::require_input(!keys_.empty(), file_ + ": the table has no parameters; name one, as in car.speed");
}

bool ParameterTable::add_key(const std::string& key) {
  const bool is_new = column_of_.emplace(key, keys_.size()).second;
  if (is_new) keys_.push_back(key);
  return is_new;
}

void ParameterTable::read_csv_rows() {
  const std::vector<CsvRow> rows = read_csv(file_, text_);
  if (rows.empty()) return;
  const auto place = [this](const CsvCell& cell) {
    return file_ + ":" + std::to_string(cell.line) + ":" + std::to_string(cell.column) + ": ";
  };
  for (const CsvCell& cell : rows.front()) {
    core::require_input(!cell.text.empty(),
                        place(cell) + "a column has no name; give its key, as in car.speed");
    core::require_input(add_key(cell.text),
                        place(cell) + "a second column " + core::in_quotes(cell.text) + "; drop one");
  }
  for (auto row = rows.begin() + 1; row != rows.end(); ++row) {
    Overrides& overrides = rows_.emplace_back();
    for (std::size_t i = 0; i < keys_.size(); ++i) {
      const CsvCell& cell = (*row)[i];
      if (!cell.text.empty())
        overrides.push_back(
            {keys_[i], value_of_cell(cell.text), place(cell) + "column " + core::in_quotes(keys_[i])});
    }
  }
}

void ParameterTable::read_toml_rows() {
  const toml::table table = parse_text({"", file_, text_});
  TableReader reader(table, "parameters");
  for (const TableReader& world : reader.tables("world")) flatten(world.toml(), "", rows_.emplace_back());
  reader.finish();
  for (const Overrides& overrides : rows_) {
    for (const Override& one : overrides) add_key(one.key);
  }
}

std::optional<double> number_in(const std::string& value) {
  try {
    const toml::table table = toml::parse("value = " + value);
    const toml::node* node = table.get("value");
    return node && node->is_number() ? node->value<double>() : std::nullopt;
  } catch (const toml::parse_error&) {
    return std::nullopt;
  }
}

std::vector<std::vector<std::string>> ParameterTable::values() const {
  std::vector<std::vector<std::string>> all;
  for (const Overrides& overrides : rows_) {
    std::vector<std::string>& row = all.emplace_back(keys_.size());
    for (const Override& one : overrides) row[column_of_.at(one.key)] = one.value;
  }
  return all;
}

}  // namespace pbmpi::scenes
