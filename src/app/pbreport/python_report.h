/// Reports in Python, which h5py and numpy serve better than C++: the package src/app/reports.
#pragma once

#include <string>
#include <vector>

#include "core/error.h"

namespace pbmpi::app {

/// The command that reports the first file of pbstudy among these arguments; empty if there is none. Throws
/// core::InputError for a study that no command reports.
std::string report_of_study_in(const std::vector<std::string>& args);

/// Checks the seals of the files named in the arguments, and becomes the Python program that reports them.
/// Returns only by an exception: core::InputError for a damaged file, core::RunError if Python cannot be
/// started.
core::ExitCode run_python_report(const std::string& command, const std::vector<std::string>& args);

/// Runs a report to its end, which writes the file `output` and says what is wrong. It ends with this
/// program, and gets no signals that are sent to this program's group. Throws core::RunError if it was killed
/// or cannot be started.
core::ExitCode run_report_for(const std::string& output, const std::vector<std::string>& words);

}  // namespace pbmpi::app
