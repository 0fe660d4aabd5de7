/// Puts rows into a table's columns, and reads them one after the other.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <type_traits>
#include <utility>
#include <variant>
#include <vector>

#include "core/error.h"
#include "core/vector.h"
#include "io/table/table_file.h"
#include "model/memory_rows.h"

namespace pbmpi::io {

/// Cuts packed rows into a column for each of their parts.
template <std::size_t N>
std::vector<TableColumn> columns_of(const std::array<model::RowPart, N>& parts,
                                    const std::vector<double>& rows) {
  std::vector<TableColumn> columns;
  std::size_t first = 0;
  for (const model::RowPart& part : parts) {
    std::vector<double> values;
    for (std::size_t at = first; at < rows.size(); at += model::row_width(parts))
      values.insert(values.end(), &rows[at], &rows[at] + part.width);
    columns.push_back({part.name, part.unit, {}, part.width});
    if (part.is_index) {
      columns.back().values = std::vector<std::int64_t>(values.begin(), values.end());
    } else {
      columns.back().values = std::move(values);
    }
    first += part.width;
  }
  return columns;
}

/// A column whose rows belong to worlds, each of which says how many it has. Throws core::RunError where the
/// column's length is not their sum, or a number is out of range.
template <class Value>
class RowReader {
 public:
  /// `file` is borrowed.
  RowReader(const TableFile& file, const std::string& table, const std::string& name, std::size_t width = 1)
      : name_("/" + table + "/" + name), values_(&file.column<Value>(table, name)), width_(width) {}

  const Value* next() {
    if (next_ + width_ > values_->size()) refuse();
    next_ += width_;
    return values_->data() + next_ - width_;
  }
  core::Vec3 vector() { return core::Vec3(next()); }
  core::Quat quaternion() {
    const Value* q = next();
    return {q[0], q[1], q[2], q[3]};
  }
  std::int32_t integer() { return in_range(*next()); }
  /// The next row as doubles, with whole numbers within the range of int; returns where the row after it
  /// begins.
  double* put(double* to) {
    const Value* from = next();
    for (std::size_t i = 0; i < width_; ++i) {
      if constexpr (std::is_integral_v<Value>) {
        *to++ = in_range(from[i]);
      } else {
        *to++ = from[i];
      }
    }
    return to;
  }
  void require_end() const {
    if (next_ != values_->size()) refuse();
  }

 private:
  std::int32_t in_range(Value value) const {
    if (!std::in_range<std::int32_t>(value)) refuse();
    return static_cast<std::int32_t>(value);
  }
  [[noreturn]] void refuse() const { throw core::RunError(name_ + " does not fit /worlds"); }

  std::string name_;
  const std::vector<Value>* values_;
  std::size_t width_, next_ = 0;
};

/// Reads the items (forces, rests) of all worlds from the table that columns_of() wrote. The column `counts`
/// of /worlds says how many each world has. Of the parts an older file has the first `num_parts` only; the
/// numbers of the others are 0.
template <class Item>
class ItemReader {
 public:
  ItemReader(const TableFile& file, const std::string& table, std::span<const model::RowPart> parts,
             const std::string& counts, std::size_t num_parts)
      : counts_(file, "worlds", counts) {
    for (const model::RowPart& part : parts) width_ += part.width;
    for (const model::RowPart& part : parts.first(num_parts)) {
      if (part.is_index) {
        columns_.emplace_back(RowReader<std::int64_t>(file, table, part.name, part.width));
      } else {
        columns_.emplace_back(RowReader<double>(file, table, part.name, part.width));
      }
    }
  }
  std::vector<Item> of_next_world() {
    std::vector<Item> items;
    std::vector<double> row(width_);
    for (int left = counts_.integer(); left > 0; --left) {
      double* to = row.data();
      for (Column& column : columns_) to = std::visit([to](auto& reader) { return reader.put(to); }, column);
      model::take_row(row.data(), items.emplace_back());
    }
    return items;
  }
  void require_end() const {
    for (const Column& column : columns_)
      std::visit([](const auto& reader) { reader.require_end(); }, column);
  }

 private:
  using Column = std::variant<RowReader<std::int64_t>, RowReader<double>>;
  RowReader<std::int64_t> counts_;
  std::vector<Column> columns_;
  std::size_t width_ = 0;
};

}  // namespace pbmpi::io
