/// Programs in Python, which h5py and numpy, and starting other programs, take better than C++: packages in
/// share/pbmpi, in a build as where it is installed.
#pragma once

#include <string>
#include <vector>

#include "core/error.h"

namespace pbmpi::app {

/// The folder of this program's file.
std::string folder_of_program();

/// The command that runs a package, with these words after it.
std::vector<std::string> python_command(const std::string& package, const std::vector<std::string>& words);

/// Becomes another program. Returns only by an exception: core::RunError if it cannot be started.
[[noreturn]] void become(std::vector<std::string> command);

/// Runs another program to its end: its exit code, or 128 and the signal that ended it; 127 if it cannot be
/// started. What it prints goes to the file `output`; without one, to where this program prints. It ends with
/// this program, and gets no signals that are sent to this program's group. Throws core::RunError.
int exit_code_of(std::vector<std::string> command, const std::string& output = "");

/// Runs a report of the package "reports" to its end, which writes the file `output` and says what is wrong.
/// Throws core::RunError if it was killed or cannot be started.
core::ExitCode run_report_for(const std::string& output, const std::vector<std::string>& words);

}  // namespace pbmpi::app
