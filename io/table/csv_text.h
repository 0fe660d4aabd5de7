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

}  // namespace pbmpi::io
