#include "scenes/format/csv_reader.h"

#include <gtest/gtest.h>

#include "core/error.h"

namespace pbmpi::scenes {
namespace {

std::vector<std::vector<std::string>> texts(const std::string& text) {
  std::vector<std::vector<std::string>> all;
  for (const CsvRow& row : read_csv("p.csv", text)) {
    std::vector<std::string>& cells = all.emplace_back();
    for (const CsvCell& cell : row) cells.push_back(cell.text);
  }
  return all;
}

using Texts = std::vector<std::vector<std::string>>;

TEST(CsvReader, takes_line_ends_of_all_systems_and_a_byte_order_mark) {
  const Texts expected = {{"a", "b"}, {"1", "2"}};
  EXPECT_EQ(texts("a,b\n1,2\n"), expected);
  EXPECT_EQ(texts("a,b\r\n1,2\r\n"), expected);
  EXPECT_EQ(texts("a,b\n1,2"), expected);
  EXPECT_EQ(texts("\xef\xbb\xbf"
                  "a,b\n1,2\n"),
            expected);
}

TEST(CsvReader, keeps_what_stands_in_quotes) {
  EXPECT_EQ(texts("a,b\n\"[1, 2]\",\" x \"\n"), (Texts{{"a", "b"}, {"[1, 2]", " x "}}));
  EXPECT_EQ(texts("a\n\"say \"\"so\"\"\"\n"), (Texts{{"a"}, {"say \"so\""}}));
  EXPECT_EQ(texts("a\n\"1\n2\"\n"), (Texts{{"a"}, {"1\n2"}}));
}

TEST(CsvReader, drops_blanks_around_a_cell_and_keeps_empty_cells) {
  EXPECT_EQ(texts("a , b\n 1,\n,2\n\"\",\"\"\n"), (Texts{{"a", "b"}, {"1", ""}, {"", "2"}, {"", ""}}));
  EXPECT_EQ(texts(""), Texts{});
}

TEST(CsvReader, knows_where_a_cell_begins) {
  const auto rows = read_csv("p.csv", "a,b\n\"x\ny\",  7\n8,9\n");
  EXPECT_EQ(rows[1][0].line, 2);
  EXPECT_EQ(rows[1][0].column, 1);
  EXPECT_EQ(rows[1][1].line, 3);  // the cell before it holds a line break
  EXPECT_EQ(rows[1][1].column, 6);
  EXPECT_EQ(rows[2][1].line, 4);
}

TEST(CsvReader, refuses_what_is_no_table) {
  const auto message = [](const std::string& text) -> std::string {
    try {
      read_csv("p.csv", text);
    } catch (const core::InputError& error) {
      return error.what();
    }
    return "";
  };
  EXPECT_EQ(message("a,b\n1,2\n1\n").find("p.csv:3:1: 1 cell, and the first line has 2"), 0u);
  EXPECT_EQ(message("a,b\n1,2,3\n").find("p.csv:2:1: 3 cells, and the first line has 2"), 0u);
  EXPECT_EQ(message("a\n1\n\n2\n").find("p.csv:3:1: an empty line"), 0u);
  EXPECT_EQ(message("a\n\"1\n").find("p.csv:2:1: this quote is not closed"), 0u);
  EXPECT_EQ(message("a\n1\"2\n").find("p.csv:2:2: a quote inside a cell"), 0u);
  EXPECT_EQ(message("a\n\"1\"2\n").find("p.csv:2:4: after the closing quote"), 0u);
}

}  // namespace
}  // namespace pbmpi::scenes
