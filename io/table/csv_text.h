/// Comma-separated values (RFC 4180) from which numbers are read back to the same bits.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "io/table/table_file.h"

namespace pbmpi::io {

/// A text with a comma, a quote or the end of a line stands in quotes.
std::string csv_text(const std::string& text);

/// One value of a column.
std::string csv_value(const TableColumn& column, std::size_t index);

/// A table: the names of its columns, then a line a row. A column of several numbers a row is name_0, name_1
/// ... `with_units`: as "name [unit]".
std::string csv_table(const std::vector<TableColumn>& columns, bool with_units = false);

}  // namespace pbmpi::io
