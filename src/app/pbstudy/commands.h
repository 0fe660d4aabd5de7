/// The studies that pbstudy can make.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "app/manual/manual.h"
#include "core/error.h"
#include "mpi/comm/communicator.h"

namespace pbmpi::app {

/// One study. It reads its own options, and its run is collective.
struct StudyCommand {
  std::string_view name;
  std::string_view meaning;  ///< one line for --help
  core::ExitCode (*run)(const mpi::Communicator& comm, const std::vector<std::string>& args);
};

const std::vector<StudyCommand>& study_commands();

/// The manual of pbstudy itself.
Manual pbstudy_manual();

/// Collective. Runs the study that args[0] names. Throws core::InputError and core::RunError, the same on
/// every rank.
core::ExitCode run_pbstudy(const mpi::Communicator& comm, const std::vector<std::string>& args);

}  // namespace pbmpi::app
