/// Reading of pbstudy's files by the reports of all studies.
#pragma once

#include <string>
#include <vector>

#include "io/table/table_file.h"

namespace pbmpi::app {

/// The attribute filetype of all files of pbstudy.
inline constexpr const char* study_filetype = "pbmpi-study";

/// The attribute `study` of the first file of pbstudy among a command's arguments, e.g. "accuracy"; empty if
/// there is none.
std::string study_named_in(const std::vector<std::string>& args);

/// Reads the file of a study of this kind. Throws core::InputError for another kind, naming the command for
/// that study.
io::TableFile read_study(const std::string& path, const std::string& kind);

/// All rows and one-dimensional columns of /cases, with a header; a column with several values becomes
/// several.
std::string study_to_csv(const io::TableFile& file);

/// The text of a value of /parameters, or `absent`.
std::string text_parameter(const io::TableFile& file, const std::string& name, const std::string& absent);

}  // namespace pbmpi::app
