/// Rows of a state (model/state_parts.h) as columns of a table.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <type_traits>
#include <utility>
#include <variant>
#include <vector>

#include "core/error.h"
#include "io/table/table_file.h"
#include "model/state_parts.h"

namespace pbmpi::io {

[[noreturn]] inline void refuse(const std::string& table, const std::string& column) {
  throw core::RunError("/" + table + "/" + column + " does not fit the other columns");
}

/// The numbers of a part as a column stores them.
template <class Number>
using StoredNumber = std::conditional_t<std::is_integral_v<Number>, std::int64_t, double>;

/// Adds a column for each part of the rows.
template <class Row>
void add_columns(std::vector<Row>& rows, std::vector<TableColumn>& columns) {
  for (const model::RowPart<Row>& part : model::parts_of<Row>) {
    std::visit(
        [&](auto first) {
          using Number = std::remove_pointer_t<decltype(first(rows.front()))>;
          std::vector<StoredNumber<Number>> values;
          values.reserve(part.width * rows.size());
          for (Row& row : rows) values.insert(values.end(), first(row), first(row) + part.width);
          columns.push_back({part.name, part.unit, std::move(values), part.width});
        },
        part.first);
  }
}

/// Inverse of add_columns(). A part of which the table has no column, as in files of an older layout, is as
/// its initialiser says. Throws core::RunError where columns differ in length, or a whole number is out of
/// range.
template <class Row>
std::vector<Row> rows_of(const TableFile& file, const std::string& table) {
  std::vector<Row> rows;
  for (const model::RowPart<Row>& part : model::parts_of<Row>) {
    const bool is_first = &part == model::parts_of<Row>.data();
    if (!is_first && !file.has_column(table, part.name)) continue;
    std::visit(
        [&](auto first) {
          using Number = std::remove_pointer_t<decltype(first(rows.front()))>;
          const auto& values = file.column<StoredNumber<Number>>(table, part.name);
          if (is_first) rows.resize(values.size() / part.width);
          if (values.size() != rows.size() * part.width) refuse(table, part.name);
          auto value = values.begin();
          for (Row& row : rows) {
            for (std::size_t i = 0; i < part.width; ++i, ++value) {
              if constexpr (std::is_integral_v<Number>) {
                if (!std::in_range<Number>(*value)) refuse(table, part.name);
              }
              first(row)[i] = static_cast<Number>(*value);
            }
          }
        },
        part.first);
  }
  return rows;
}

}  // namespace pbmpi::io
