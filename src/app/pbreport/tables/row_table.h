/// Rows of any kind as the columns of a table.
#pragma once

#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include "io/table/table_file.h"

namespace pbmpi::app {

/// Each column is a function of the row that returns a double, a std::int64_t or a std::string.
template <class Row>
class RowTable {
 public:
  /// `rows` is borrowed.
  explicit RowTable(const std::vector<Row>& rows) : rows_(rows) {}

  template <class ValueOf>
  void add(const std::string& name, const std::string& unit, ValueOf&& value_of) {
    using Value = std::decay_t<decltype(value_of(rows_.front()))>;
    std::vector<Value> values;
    for (const Row& row : rows_) values.push_back(value_of(row));
    columns.push_back({name, unit, std::move(values), 1});
  }

  std::vector<io::TableColumn> columns;

 private:
  const std::vector<Row>& rows_;
};

}  // namespace pbmpi::app
