/// Runs other programs to their end.
#pragma once

#include <string>
#include <utility>
#include <vector>

namespace pbmpi::core {

struct Child {
  std::vector<std::string> command;  ///< the program is searched in PATH unless its name has a slash
  std::vector<std::pair<std::string, std::string>> environment;  ///< added to this program's own
  std::string output_file, error_file;                           ///< for its standard output and errors
  double time_limit_s = 0;
};

/// exit_code: as a shell gives it, 128 + the signal for a program that a signal ended.
struct ChildEnd {
  int exit_code = 0;
  bool timed_out = false;
};

/// Runs the program and waits. It does not inherit what mpirun has set for this program (OMPI_*, PMIX_*), so
/// that a program with MPI starts on its own. It ends with this program. Throws core::RunError if it cannot
/// be started.
ChildEnd run_child(const Child& child);

/// The folder of this program's file.
std::string folder_of_program();

}  // namespace pbmpi::core
