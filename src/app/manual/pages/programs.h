/// The three programs as the manual describes them.
#pragma once

#include <string>
#include <vector>

#include "app/manual/manual.h"

namespace pbmpi::app {

struct ProgramManual {
  Manual program;
  std::vector<Manual> commands;  ///< "pbreport csv" ...; none for pbmpi
  bool reads_files = false;      ///< words without a dash are files
};

std::vector<ProgramManual> all_manuals();

/// "csv" for "pbreport csv".
std::string word_of(const Manual& command);
/// "pbreport-csv" for "pbreport csv".
std::string page_name(const Manual& manual);

/// The text on one line, cut at the end of a word within `most` letters: what a shell shows beside an option.
std::string one_line(const std::string& text, std::size_t most);

}  // namespace pbmpi::app
