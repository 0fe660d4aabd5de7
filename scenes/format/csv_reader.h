/// Comma-separated values in the format of RFC 4180.
#pragma once

#include <string>
#include <vector>

namespace pbmpi::scenes {

struct CsvCell {
  std::string text;          ///< without the quotes; an unquoted cell loses the blanks around it
  int line = 1, column = 1;  ///< where the cell begins, from 1
};
using CsvRow = std::vector<CsvCell>;

/// Reads all lines of a text, each with as many cells as the first. `file`: its name in messages. A byte
/// order mark and a line break at the end are skipped. Throws core::InputError "file:line:column: ..." for
/// lines of another length, empty lines, or a quote that is not closed or stands inside an unquoted cell.
std::vector<CsvRow> read_csv(const std::string& file, const std::string& text);

}  // namespace pbmpi::scenes
