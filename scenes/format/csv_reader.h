/// Comma-separated values as RFC 4180 has them.
#pragma once

#include <string>
#include <vector>

namespace pbmpi::scenes {

struct CsvCell {
  std::string text;          ///< without the quotes; blanks around a cell that has none are dropped
  int line = 1, column = 1;  ///< where it begins, from 1
};
using CsvRow = std::vector<CsvCell>;

/// All lines of a text, each with as many cells as the first. `file`: what messages call it. A byte order
/// mark, and a line break at the end, are passed over. Throws core::InputError "file:line:column: ...": lines
/// of another length, empty ones, a quote that is not closed or stands inside a cell without quotes.
std::vector<CsvRow> read_csv(const std::string& file, const std::string& text);

}  // namespace pbmpi::scenes
