#include "app/pbreport/study/study_file.h"

#include "app/common/format.h"
#include "core/error.h"

namespace pbmpi::app {
namespace {

/// The files of the first version had accuracy studies only, and did not say so.
std::string kind_of(const io::TableFile& file) {
  const auto study = file.attributes.find("study");
  return study == file.attributes.end() ? "accuracy" : study->second;
}

/// One value of a column as text.
class CellText {
 public:
  explicit CellText(std::size_t index) : index_(index) {}
  std::string operator()(const std::vector<double>& values) const { return format("%.17g", values[index_]); }
  std::string operator()(const std::vector<std::int64_t>& values) const {
    return std::to_string(values[index_]);
  }
  std::string operator()(const std::vector<std::string>& values) const { return quoted(values[index_]); }

 private:
  /// RFC 4180: a text with a comma or a quote stands in quotes.
  static std::string quoted(const std::string& text) {
    if (text.find_first_of(",\"\n") == std::string::npos) return text;
    std::string result = "\"";
    for (const char c : text) result += c == '"' ? "\"\"" : std::string(1, c);
    return result + "\"";
  }

  std::size_t index_;
};

}  // namespace

std::string study_named_in(const std::vector<std::string>& args) {
  for (const std::string& arg : args) {
    if (arg.empty() || arg.front() == '-' || io::filetype_of(arg) != study_filetype) continue;
    return kind_of(io::read_table_file(arg, study_filetype));
  }
  return {};
}

io::TableFile read_study(const std::string& path, const std::string& kind) {
  io::TableFile file = io::read_table_file(path, study_filetype);
  const std::string found = kind_of(file);
  core::require_input(found == kind, path + ": a study of " + found + ", not of " + kind + "; try pbreport " +
                                         (found == "accuracy" ? "study" : found));
  return file;
}

std::string study_to_csv(const io::TableFile& file) {
  const std::vector<io::TableColumn>& columns = file.tables.at("cases");
  std::string text;
  for (const io::TableColumn& column : columns) {
    for (std::size_t k = 0; k < column.width; ++k) {
      text += (text.empty() ? "" : ",") + column.name + (column.width > 1 ? "_" + std::to_string(k) : "");
    }
  }
  text += "\n";
  for (std::size_t row = 0; row < columns.front().num_rows(); ++row) {
    std::string line;
    for (const io::TableColumn& column : columns) {
      for (std::size_t k = 0; k < column.width; ++k) {
        line += (line.empty() ? "" : ",") + std::visit(CellText(row * column.width + k), column.values);
      }
    }
    text += line + "\n";
  }
  return text;
}

std::string text_parameter(const io::TableFile& file, const std::string& name, const std::string& absent) {
  for (const io::Parameter& parameter : file.parameters) {
    if (parameter.name == name) return parameter.text;
  }
  return absent;
}

}  // namespace pbmpi::app
