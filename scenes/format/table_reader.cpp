#include "scenes/format/table_reader.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <sstream>

#include "core/error.h"
#include "core/quantity.h"
#include "core/text.h"
#include "scenes/parts/parts.h"

namespace pbmpi::scenes {
namespace {

std::string to_text(double value) {
  std::ostringstream out;
  out << value;
  return out.str();
}

}  // namespace

std::string to_string(const toml::source_region& source) {
  if (source.path && source.path->starts_with(place_mark)) return source.path->substr(1);
  return (source.path ? *source.path : std::string("scene")) + ":" + std::to_string(source.begin.line) + ":" +
         std::to_string(source.begin.column);
}

TableReader::TableReader(const toml::table& table, std::string what)
    : table_(&table), what_(std::move(what)) {}

const toml::node* TableReader::find(std::string_view key) {
  if (std::find(known_.begin(), known_.end(), key) == known_.end()) known_.emplace_back(key);
  return table_->get(key);
}

const toml::node& TableReader::need(std::string_view key) {
  const toml::node* node = find(key);
  if (!node) fail_missing(key);
  return *node;
}

/// Names the key that may stand there with a typing error.
void TableReader::fail_missing(std::string_view key) const {
  std::vector<std::string> others = keys();
  std::erase_if(others,
                [&](const std::string& one) { return std::ranges::find(known_, one) != known_.end(); });
  const std::string near = core::nearest_name(key, others);
  if (near.empty()) fail_at(*table_, "the key " + core::in_quotes(key) + " is missing; add it");
  fail(near,
       "the key " + core::in_quotes(key) + " is missing; is " + core::in_quotes(near) + " meant for it?");
}

const toml::array& TableReader::need_array(std::string_view key, std::string_view form) {
  const toml::node& node = need(key);
  if (!node.is_array()) fail_at(node, core::in_quotes(key) + " must be an array " + std::string(form));
  return *node.as_array();
}

double TableReader::checked_number(std::string_view key, const toml::node& node, Sign sign,
                                   Range range) const {
  if (!node.is_number()) fail_at(node, core::in_quotes(key) + " must be a number");
  // node.value<double>() returns nothing for integers that no double represents exactly.
  const double value =
      node.is_integer() ? static_cast<double>(node.as_integer()->get()) : node.as_floating_point()->get();
  const auto refuse = [&](std::string_view rule) {
    fail_at(node, core::in_quotes(key) + " is " + to_text(value) + "; it must be " + std::string(rule));
  };
  if (std::isnan(value) || (range == Range::finite && !std::isfinite(value))) refuse("finite");
  if (sign == Sign::positive && value <= 0) refuse("above 0");
  if (sign == Sign::non_negative && value < 0) refuse("at least 0");
  if (const std::string_view bound = core::bound_against(value, sign == Sign::positive); !bound.empty())
    refuse(bound);
  return value;
}

int TableReader::checked_integer(std::string_view key, const toml::node& node, int least) const {
  if (!node.is_integer()) fail_at(node, core::in_quotes(key) + " must be a whole number");
  const std::int64_t value = node.as_integer()->get();
  if (value < least || value > std::numeric_limits<int>::max()) {
    fail_at(node, core::in_quotes(key) + " is " + std::to_string(value) + "; it must be at least " +
                      std::to_string(least) + " and below 2^31");
  }
  return static_cast<int>(value);
}

core::Vec3 TableReader::checked_vector(std::string_view key, const toml::node& node, Sign sign,
                                       Range range) const {
  const toml::array* array = node.as_array();
  if (!array || array->size() != 3)
    fail_at(node, core::in_quotes(key) + " must have three numbers [x, y, z]");
  core::Vec3 result;
  for (int i = 0; i < 3; ++i) result[i] = checked_number(key, (*array)[i], sign, range);
  return result;
}

bool TableReader::has(std::string_view key) { return find(key) != nullptr; }

bool TableReader::is_array(std::string_view key) {
  const toml::node* node = find(key);
  return node && node->is_array();
}

bool TableReader::is_nested_array(std::string_view key) {
  const toml::node* node = find(key);
  return node && node->is_array() && !node->as_array()->empty() && node->as_array()->front().is_array();
}

double TableReader::number(std::string_view key, Sign sign, std::optional<double> fallback) {
  if (fallback && !has(key)) return *fallback;
  return checked_number(key, need(key), sign);
}

double TableReader::number_or_infinity(std::string_view key, Sign sign, std::optional<double> fallback) {
  if (fallback && !has(key)) return *fallback;
  return checked_number(key, need(key), sign, Range::infinite);
}

int TableReader::integer(std::string_view key, int least, std::optional<int> fallback) {
  if (fallback && !has(key)) return *fallback;
  return checked_integer(key, need(key), least);
}

bool TableReader::flag(std::string_view key, bool fallback) {
  if (!has(key)) return fallback;
  const toml::node& node = need(key);
  if (!node.is_boolean()) fail_at(node, core::in_quotes(key) + " must be true or false");
  return node.as_boolean()->get();
}

std::string TableReader::text(std::string_view key, const std::optional<std::string>& fallback) {
  if (fallback && !has(key)) return *fallback;
  const toml::node& node = need(key);
  if (!node.is_string()) fail_at(node, core::in_quotes(key) + " must be a \"text\"");
  if (node.as_string()->get().empty()) fail_at(node, core::in_quotes(key) + " must not be empty");
  return node.as_string()->get();
}

std::size_t TableReader::choice(std::string_view key, std::span<const std::string_view> names,
                                const std::optional<std::string>& fallback) {
  const std::string name = text(key, fallback);
  const auto found = std::ranges::find(names, name);
  if (found != names.end()) return static_cast<std::size_t>(found - names.begin());
  fail(key, "unknown " + std::string(key) + " " + core::in_quotes(name) +
                core::suggestion(name, {names.begin(), names.end()}));
}

core::Vec3 TableReader::vector(std::string_view key, Sign sign, const std::optional<core::Vec3>& fallback) {
  if (fallback && !has(key)) return *fallback;
  return checked_vector(key, need_array(key, "[x, y, z]"), sign);
}

core::Vec3 TableReader::vector_or_infinity(std::string_view key) {
  return checked_vector(key, need_array(key, "[x, y, z]"), Sign::any, Range::infinite);
}

core::Vec3 TableReader::direction(std::string_view key, const std::optional<core::Vec3>& fallback) {
  const core::Vec3 value = vector(key, Sign::any, fallback);
  if (value.norm() < 1e-9) fail(key, core::in_quotes(key) + " has no direction; give one that is not zero");
  return value.normalized();
}

core::Quat TableReader::rotation(std::string_view key) {
  auto turn = table(key);
  if (!turn) return {};
  const core::Vec3 axis = turn->direction("axis");
  const double angle_deg = turn->number("angle", Sign::any);
  turn->finish();
  return scenes::rotation(radians(angle_deg), axis);
}

std::vector<std::string> TableReader::texts(std::string_view key) {
  std::vector<std::string> result;
  for (const toml::node& node : need_array(key, "[\"a\", \"b\"]")) {
    if (!node.is_string() || node.as_string()->get().empty()) {
      fail_at(node, "each entry of " + core::in_quotes(key) + " must be a \"text\"");
    }
    result.push_back(node.as_string()->get());
  }
  return result;
}

std::vector<int> TableReader::integers(std::string_view key, int least) {
  std::vector<int> result;
  for (const toml::node& node : need_array(key, "[a, b]"))
    result.push_back(checked_integer(key, node, least));
  if (result.empty()) fail(key, core::in_quotes(key) + " is empty; give at least one number");
  return result;
}

std::vector<core::Vec3> TableReader::vectors(std::string_view key, Sign sign) {
  std::vector<core::Vec3> result;
  for (const toml::node& node : need_array(key, "[[x, y, z], [x, y, z]]"))
    result.push_back(checked_vector(key, node, sign));
  if (result.empty()) fail(key, core::in_quotes(key) + " is empty; give at least one [x, y, z]");
  return result;
}

std::vector<std::vector<double>> TableReader::rows(std::string_view key) {
  std::vector<std::vector<double>> result;
  for (const toml::node& node : need_array(key, "[[a, b], [c, d]]")) {
    const toml::array* entry = node.as_array();
    if (!entry || entry->empty() || (!result.empty() && entry->size() != result.front().size()))
      fail_at(node, "each row of " + core::in_quotes(key) + " must have as many numbers as the first");
    std::vector<double>& row = result.emplace_back();
    for (const toml::node& number : *entry) row.push_back(checked_number(key, number, Sign::any));
  }
  if (result.empty()) fail(key, core::in_quotes(key) + " is empty; give rows of numbers");
  return result;
}

std::array<double, 2> TableReader::pair(std::string_view key) {
  const toml::array& array = need_array(key, "[a, b]");
  if (array.size() != 2) fail_at(array, core::in_quotes(key) + " must have two numbers [a, b]");
  return {checked_number(key, array[0], Sign::any), checked_number(key, array[1], Sign::any)};
}

std::vector<std::array<double, 2>> TableReader::ascending_pairs(std::string_view key) {
  std::vector<std::array<double, 2>> result;
  if (!has(key)) return result;
  for (const toml::node& node : need_array(key, "[[a, b], [c, d]]")) {
    const toml::array* entry = node.as_array();
    if (!entry || entry->size() != 2) {
      fail_at(node, "each entry of " + core::in_quotes(key) + " must have two numbers [a, b]");
    }
    result.push_back(
        {checked_number(key, (*entry)[0], Sign::non_negative), checked_number(key, (*entry)[1], Sign::any)});
    if (result.size() > 1 && result.back()[0] <= result[result.size() - 2][0]) {
      fail_at(node, "the entries of " + core::in_quotes(key) + " must ascend in their first number");
    }
  }
  if (result.empty()) fail(key, core::in_quotes(key) + " is empty; give at least one pair");
  return result;
}

std::optional<TableReader> TableReader::table(std::string_view key) {
  const toml::node* node = find(key);
  if (!node) return std::nullopt;
  if (!node->is_table()) fail_at(*node, core::in_quotes(key) + " must be a table");
  return TableReader(*node->as_table(), what_ + ", " + std::string(key));
}

std::vector<TableReader> TableReader::tables(std::string_view key) {
  std::vector<TableReader> result;
  const toml::node* node = find(key);
  if (!node) return result;
  if (!node->is_array()) fail_at(*node, "write [[" + std::string(key) + "]], with two brackets");
  for (const toml::node& entry : *node->as_array()) {
    if (!entry.is_table()) fail_at(entry, "write [[" + std::string(key) + "]] tables");
    result.emplace_back(*entry.as_table(), std::string(key));
  }
  return result;
}

std::vector<std::string> TableReader::keys() const {
  std::vector<std::string> result;
  for (const auto& [key, node] : *table_) result.emplace_back(key.str());
  return result;
}

void TableReader::finish() const {
  for (const auto& [key, node] : *table_) {
    if (std::find(known_.begin(), known_.end(), key.str()) != known_.end()) continue;
    throw core::InputError(to_string(key.source()) + ": " + what_ + ": unknown key " +
                           core::in_quotes(key.str()) + core::suggestion(key.str(), known_));
  }
}

std::string TableReader::where(std::string_view key) const {
  const toml::node* node = table_->get(key);
  return to_string(node ? node->source() : table_->source());
}

std::string TableReader::where() const { return to_string(table_->source()); }

void TableReader::fail(std::string_view key, const std::string& problem) const {
  const toml::node* node = table_->get(key);
  fail_at(node ? *node : *table_, problem);
}

void TableReader::fail_at(const toml::node& node, const std::string& problem) const {
  throw core::InputError(to_string(node.source()) + ": " + what_ + ": " + problem);
}

}  // namespace pbmpi::scenes
