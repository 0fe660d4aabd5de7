#include "io/table/csv_text.h"

#include "core/number_text.h"

namespace pbmpi::io {
namespace {

struct ValueText {
  std::size_t index;
  std::string operator()(const std::vector<std::string>& values) const { return csv_text(values[index]); }
  template <class Number>
  std::string operator()(const std::vector<Number>& values) const {
    return core::number_text(values[index]);
  }
};

}  // namespace

std::string csv_text(const std::string& text) {
  if (text.find_first_of(",\"\n\r") == std::string::npos) return text;
  std::string quoted = "\"";
  for (const char c : text) quoted += c == '"' ? "\"\"" : std::string(1, c);
  return quoted + "\"";
}

std::string csv_value(const TableColumn& column, std::size_t index) {
  return std::visit(ValueText{index}, column.values);
}

std::string csv_table(const std::vector<TableColumn>& columns, bool with_units) {
  std::string text;
  for (const TableColumn& column : columns) {
    for (std::size_t k = 0; k < column.width; ++k) {
      text += (text.empty() ? "" : ",") + column.name + (column.width > 1 ? "_" + std::to_string(k) : "");
      if (with_units && !column.unit.empty()) text += " [" + column.unit + "]";
    }
  }
  text += "\n";
  for (std::size_t row = 0; !columns.empty() && row < columns.front().num_rows(); ++row) {
    const std::size_t begin = text.size();
    for (const TableColumn& column : columns) {
      for (std::size_t k = 0; k < column.width; ++k) text += csv_value(column, row * column.width + k) + ",";
    }
    if (text.size() > begin) text.pop_back();
    text += "\n";
  }
  return text;
}

}  // namespace pbmpi::io
