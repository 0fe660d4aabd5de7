#include "app/pbreport/study/study_file.h"

#include "core/error.h"
#include "io/table/csv_text.h"

namespace pbmpi::app {
namespace {

/// The first version of the files had only accuracy studies, and did not say so.
std::string kind_of(const io::TableFile& file) {
  const auto study = file.attributes.find("study");
  return study == file.attributes.end() ? "accuracy" : study->second;
}

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

std::string study_to_csv(const io::TableFile& file) { return io::csv_table(file.tables.at("cases")); }

std::string text_parameter(const io::TableFile& file, const std::string& name, const std::string& absent) {
  for (const io::Parameter& parameter : file.parameters) {
    if (parameter.name == name) return parameter.text;
  }
  return absent;
}

}  // namespace pbmpi::app
