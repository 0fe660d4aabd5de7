/// "pbreport [study] accuracy.h5": what accuracy costs in time, and which setting to take.
#pragma once

#include <iosfwd>
#include <string>
#include <vector>

#include "core/error.h"

namespace pbmpi::app {

/// The attribute filetype of all files of pbstudy.
inline constexpr const char* study_filetype = "pbmpi-study";

/// Throws core::InputError if `path` cannot be written.
void write_text(const std::string& path, const std::string& text);

/// Throws core::InputError: bad usage, a file that is no study, an output that cannot be written, a budget or
/// tolerance that no setting keeps where a preset is asked for.
core::ExitCode run_study(const std::vector<std::string>& args, std::ostream& out);

/// Does one of `args` name a file of pbstudy?
bool names_a_study(const std::vector<std::string>& args);

}  // namespace pbmpi::app
