#include "scenes/format/csv_reader.h"

#include <cstddef>
#include <string_view>
#include <utility>

#include "core/error.h"

namespace pbmpi::scenes {
namespace {

class CsvReader {
 public:
  CsvReader(const std::string& file, std::string_view text) : file_(file), rest_(text) {
    constexpr std::string_view byte_order_mark = "\xef\xbb\xbf";
    if (rest_.starts_with(byte_order_mark)) rest_.remove_prefix(byte_order_mark.size());
  }

  bool at_end() const { return rest_.empty(); }

  CsvRow row() {
    CsvRow row;
    const int line = line_;
    do row.push_back(cell());
    while (take(','));
    if (!at_end() && !take_line_break()) fail("after the closing quote comes a comma or the end of the line");
    if (row.size() == 1 && row.front().text.empty() && !row_is_quoted_)
      fail(line, 1, "an empty line; remove it (\"\" is an empty cell)");
    return row;
  }

 private:
  CsvCell cell() {
    while (!at_end() && (rest_.front() == ' ' || rest_.front() == '\t')) next();
    row_is_quoted_ = !at_end() && rest_.front() == '"';
    return row_is_quoted_ ? quoted_cell() : plain_cell();
  }

  CsvCell quoted_cell() {
    CsvCell cell{"", line_, column_};
    next();
    while (true) {
      if (at_end())
        fail(cell.line, cell.column, "this quote is not closed; write \"\" for one inside a cell");
      if (rest_.front() == '"') {
        next();
        if (at_end() || rest_.front() != '"') break;
      }
      cell.text += rest_.front();
      next();
    }
    while (!at_end() && (rest_.front() == ' ' || rest_.front() == '\t')) next();
    return cell;
  }

  CsvCell plain_cell() {
    CsvCell cell{"", line_, column_};
    while (!at_end() && rest_.front() != ',' && !at_line_break()) {
      if (rest_.front() == '"') fail("a quote inside a cell that does not begin with one; quote all of it");
      cell.text += rest_.front();
      next();
    }
    cell.text.resize(cell.text.find_last_not_of(" \t") + 1);
    return cell;
  }

  bool at_line_break() const { return rest_.starts_with("\n") || rest_.starts_with("\r\n"); }
  bool take_line_break() {
    if (!at_line_break()) return false;
    if (rest_.front() == '\r') next();
    next();
    return true;
  }
  bool take(char c) {
    if (at_end() || rest_.front() != c) return false;
    next();
    return true;
  }
  void next() {
    if (rest_.front() == '\n') {
      ++line_;
      column_ = 0;
    }
    ++column_;
    rest_.remove_prefix(1);
  }
  [[noreturn]] void fail(const std::string& problem) const { fail(line_, column_, problem); }
  [[noreturn]] void fail(int line, int column, const std::string& problem) const {
    throw core::InputError(file_ + ":" + std::to_string(line) + ":" + std::to_string(column) + ": " +
                           problem);
  }

  const std::string& file_;
  std::string_view rest_;
  int line_ = 1, column_ = 1;
  bool row_is_quoted_ = false;  ///< whether the last cell is quoted
};

}  // namespace

std::vector<CsvRow> read_csv(const std::string& file, const std::string& text) {
  CsvReader reader(file, text);
  std::vector<CsvRow> rows;
  while (!reader.at_end()) {
    CsvRow row = reader.row();
    if (!rows.empty() && row.size() != rows.front().size())
      throw core::InputError(file + ":" + std::to_string(row.front().line) +
                             ":1: " + std::to_string(row.size()) + (row.size() == 1 ? " cell" : " cells") +
                             ", and the first line has " + std::to_string(rows.front().size()) +
                             "; give each line as many (a cell with a comma needs quotes)");
    rows.push_back(std::move(row));
  }
  return rows;
}

}  // namespace pbmpi::scenes
