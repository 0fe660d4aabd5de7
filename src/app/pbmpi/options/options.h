/// The command line of pbmpi, and the run that it and the scene together describe.
#pragma once

#include <cstdint>
#include <optional>
#include <set>
#include <span>
#include <string>
#include <vector>

#include "app/common/options.h"
#include "app/common/step_arguments.h"
#include "app/manual/manual.h"
#include "app/pbmpi/options/run_spec.h"

namespace pbmpi::app {

enum class Action { run, help, version, list_scenes, describe };

/// The command line as given.
struct Options {
  Action action = Action::run;
  RunSpec run;  ///< members of options that are not `given` are left to the scene
  std::set<std::string, std::less<>> given;  ///< names in run_options()
  stepping::StepChoices step;
  std::optional<std::string> feec;     ///< with FEEC: what estimates, as given (estimate_settings())
  std::vector<core::NamedPath> paths;  ///< named on the command line
  CommonOptions common;
  std::string command_line;

  /// What replaces the scene's own values before it is built.
  std::optional<double> dt_s() const {
    return step.has("dt") ? std::optional(step.settings.dt_s) : std::nullopt;
  }
};

/// `saved`: further options that all others override, one "name = value" a line. Throws core::InputError with
/// one clear message.
Options parse_options(const std::vector<std::string>& args, const std::string& saved = "");

Manual pbmpi_manual();

/// What a resumed run needs to know about the run that wrote the checkpoint.
struct ResumePoint {
  std::string path;         ///< of the checkpoint; empty: the run begins anew
  std::int64_t frames = 0;  ///< done, warm-up included
  std::string output;       ///< of the run that wrote the checkpoint, or empty
};

/// Settles what the command line leaves to the scene, and what follows from it. Throws core::InputError for
/// what is impossible together. `num_rows`: of the table of parameters, if there is one.
RunSpec resolve(const Options& options, const scenes::Scene& scene, const ResumePoint& from = {},
                std::optional<int> num_rows = std::nullopt);

/// How the work of a run is cut.
struct Cut {
  Decomposition decomposition = Decomposition::worlds;
  mpi::RankGroups groups;  ///< with spaces
};

/// The cut for this many ranks. Unless asked otherwise, worlds are cut into spaces if the stepper is sor, a
/// world has more than one space, there are more ranks than worlds, and either there is one world or groups
/// of ranks are predicted to be done sooner. `space_costs`: mpi::space_costs() of world 0, from which the
/// groups for all worlds are chosen. Throws core::InputError where spaces are asked for and not possible.
Cut decompose(const RunSpec& spec, std::span<const double> space_costs, int num_ranks);

/// All options except the scene that decide the bits of a run, and those that a resumed run keeps unless told
/// otherwise: values as resolved, one "name = value" a line, as in a file of --config.
std::string saved_options(const RunSpec& spec);

/// Throws core::InputError unless `now` is the stepper of `saved`, without which its other options make no
/// sense. `path`: the checkpoint's.
void require_same_stepper(const std::string& path, const std::string& saved, stepping::StepperKind now);

/// Throws core::InputError unless `now` has the physics of `saved`; both come from saved_options().
void require_same_physics(const std::string& path, const std::string& saved, const std::string& now);

}  // namespace pbmpi::app
