/// The studies that pbstudy can make.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "app/manual/manual.h"
#include "app/pbstudy/study/studies.h"

namespace pbmpi::app {

/// One study, which reads its own options.
struct StudyCommand {
  std::string_view name;
  std::string_view meaning;  ///< one line for --help
  Study* run;
  Manual (*manual)();
};

const std::vector<StudyCommand>& study_commands();

/// The manual of pbstudy itself.
Manual pbstudy_manual();

/// Collective. Runs the study that args[0] names. Throws core::InputError and core::RunError, the same on
/// every rank.
core::ExitCode run_pbstudy(const mpi::Communicator& comm, const std::vector<std::string>& args);

}  // namespace pbmpi::app
