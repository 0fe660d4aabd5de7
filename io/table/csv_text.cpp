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

}  // namespace pbmpi::io
