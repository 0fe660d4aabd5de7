/// Comma-separated values (RFC 4180) from which numbers are read back to the same bits.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "io/table/table_file.h"

namespace pbmpi::io {

/// Quotes a text that has a comma, a quote or an end of line.
std::string csv_text(const std::string& text);

/// One value of a column.
std::string csv_value(const TableColumn& column, std::size_t index);

/// A table: a line with the names of its columns, then a line per row. A column with several numbers per row
/// becomes name_0, name_1 ... `with_units`: the names become "name [unit]".
std::string csv_table(const std::vector<TableColumn>& columns, bool with_units = false);

}  // namespace pbmpi::io
