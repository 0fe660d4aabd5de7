/// Reads one TOML table with types, ranges and the place of each error.
#pragma once

#include <array>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include <toml++/toml.h>

#include "core/vector.h"

namespace pbmpi::scenes {

/// The allowed sign of a number, which must always be finite and within core/quantity.h.
enum class Sign { any, positive, non_negative };

/// Each getter marks its key as known; finish() then refuses every other key. All errors are core::InputError
/// "file:line:column: what: ...". A getter without a fallback requires its key.
class TableReader {
 public:
  /// `table` must outlive the reader; `what` names it in messages, e.g. "actor 'car'".
  TableReader(const toml::table& table, std::string what);

  bool has(std::string_view key);
  bool is_array(std::string_view key);
  /// Is the value an array that begins with an array?
  bool is_nested_array(std::string_view key);
  double number(std::string_view key, Sign sign, std::optional<double> fallback = std::nullopt);
  /// A number that may also be infinite (`inf` in TOML).
  double number_or_infinity(std::string_view key, Sign sign, std::optional<double> fallback = std::nullopt);
  int integer(std::string_view key, int least, std::optional<int> fallback = std::nullopt);
  bool flag(std::string_view key, bool fallback);
  std::string text(std::string_view key, const std::optional<std::string>& fallback = std::nullopt);
  /// Index of the text in `names`; refuses any other, with the nearest names.
  std::size_t choice(std::string_view key, std::span<const std::string_view> names,
                     const std::optional<std::string>& fallback = std::nullopt);
  core::Vec3 vector(std::string_view key, Sign sign,
                    const std::optional<core::Vec3>& fallback = std::nullopt);
  core::Vec3 vector_or_infinity(std::string_view key);
  /// Reads a vector and scales it to unit length; refuses zero.
  core::Vec3 direction(std::string_view key, const std::optional<core::Vec3>& fallback = std::nullopt);
  /// Reads `key = { axis = [x, y, z], angle = deg }`; the identity without the key.
  core::Quat rotation(std::string_view key = "rotation");
  std::vector<std::string> texts(std::string_view key);
  /// Reads [a, b, ...], not empty.
  std::vector<int> integers(std::string_view key, int least);
  /// Reads [[x, y, z], ...], not empty.
  std::vector<core::Vec3> vectors(std::string_view key, Sign sign);
  /// Reads [[a, b, ...], [c, d, ...], ...], rows of equal length, not empty.
  std::vector<std::vector<double>> rows(std::string_view key);
  /// Reads [a, b].
  std::array<double, 2> pair(std::string_view key);
  /// Reads [[a, b], [c, d], ...] with a < c < ...; empty without the key.
  std::vector<std::array<double, 2>> ascending_pairs(std::string_view key);
  /// Reads a sub-table; nothing without the key.
  std::optional<TableReader> table(std::string_view key);
  /// Reads [[key]] tables; empty without the key.
  std::vector<TableReader> tables(std::string_view key);

  const toml::table& toml() const { return *table_; }

  /// The table's own keys, whether read or not, in alphabetical order.
  std::vector<std::string> keys() const;

  /// To be called when all keys have been read.
  void finish() const;

  /// Renames the table in messages, once its name is known.
  void set_what(std::string what) { what_ = std::move(what); }
  const std::string& what() const { return what_; }
  /// "file:line:column" of the value of `key`, or of the table if there is no such key.
  std::string where(std::string_view key) const;
  std::string where() const;
  /// Throws core::InputError at the value of `key`.
  [[noreturn]] void fail(std::string_view key, const std::string& problem) const;

 private:
  const toml::node* find(std::string_view key);
  const toml::node& need(std::string_view key);
  [[noreturn]] void fail_missing(std::string_view key) const;
  const toml::array& need_array(std::string_view key, std::string_view form);
  enum class Range { finite, infinite };
  double checked_number(std::string_view key, const toml::node& node, Sign sign,
                        Range range = Range::finite) const;
  int checked_integer(std::string_view key, const toml::node& node, int least) const;
  core::Vec3 checked_vector(std::string_view key, const toml::node& node, Sign sign,
                            Range range = Range::finite) const;
  [[noreturn]] void fail_at(const toml::node& node, const std::string& problem) const;

  const toml::table* table_;
  std::string what_;
  std::vector<std::string> known_;
};

/// Marks the name of a text that is part of another text and holds its own place, e.g. a cell of a table.
inline constexpr char place_mark = '\x1f';

/// "file:line:column", or the place that the text's name holds.
std::string to_string(const toml::source_region& source);

}  // namespace pbmpi::scenes
