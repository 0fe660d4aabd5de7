/// The commands of pbreport: "pbreport FILE" is short for "pbreport report FILE".
#pragma once

#include <iosfwd>
#include <string>
#include <string_view>
#include <vector>

#include "app/manual/manual.h"
#include "core/error.h"

namespace pbmpi::app {

/// One thing that pbreport can do. A command reads its own options.
struct ReportCommand {
  std::string_view name;
  std::string_view meaning;  ///< one line for --help
  core::ExitCode (*run)(const std::vector<std::string>& args, std::ostream& out) = nullptr;  ///< none: Python
};

/// The first one runs when the first argument names no command.
const std::vector<ReportCommand>& report_commands();

/// "pbreport join A B ... -o ALL": a run and the runs resumed from its checkpoints as one file. Throws
/// core::InputError: bad usage, files that are not of one run, frames that are missing or differ.
core::ExitCode run_join(const std::vector<std::string>& args, std::ostream& out);
/// "pbreport repair FILE": frees the disk space that a killed run still occupies. Throws core::InputError:
/// bad usage, a file that is not a run's, or one that a run is still writing.
core::ExitCode run_repair(const std::vector<std::string>& args, std::ostream& out);

/// Manual of pbreport itself and of the first command.
Manual pbreport_manual();

/// Runs the command named by args[0] with the arguments after it, or else the first command with all of them.
/// Prints to `out`. Throws core::InputError and core::RunError.
core::ExitCode run_pbreport(const std::vector<std::string>& args, std::ostream& out);

}  // namespace pbmpi::app
