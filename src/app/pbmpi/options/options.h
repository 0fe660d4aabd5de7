/// The command line of pbmpi, and the run that it and the scene together describe.
#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "app/common/estimate_spec.h"
#include "app/common/options.h"
#include "app/common/step_arguments.h"
#include "app/manual/manual.h"
#include "mpi/spaces/plan/rank_groups.h"
#include "scenes/scene.h"
#include "stability/on_blowup.h"
#include "stepping/frame_budget.h"
#include "stepping/stepper.h"

namespace pbmpi::app {

enum class Action { run, help, version, list_scenes, describe };
enum class ReportFormat { text, json };
enum class Decomposition { automatic, worlds, spaces };
inline constexpr std::array<std::string_view, 3> decomposition_names = {"auto", "worlds", "spaces"};
inline constexpr std::array<std::string_view, 2> spaces_names = {"one", "many"};

/// Worlds first .. end - 1 of an ensemble.
struct WorldRange {
  int first = 0, end = 0;
};

/// The command line as given; missing options are left to the scene.
struct Options {
  Action action = Action::run;
  std::string scene;
  std::optional<int> replicas, frames, warmup, steps_per_frame;
  std::optional<std::string> parameters;  ///< path of the table
  std::optional<WorldRange> world_range;
  stepping::StepChoices step;
  Decomposition decomposition = Decomposition::automatic;  ///< as asked, until decompose() decides it
  std::optional<int> ranks_per_world;
  std::uint64_t seed = 1;
  bool feec = false;
  std::map<std::string, std::string, std::less<>> estimate;  ///< step options of the estimate, as given
  std::optional<int> estimate_after;
  std::optional<double> estimate_by_s;
  std::optional<std::string> output;
  bool no_output = false;
  bool record_islands = false;
  bool record_residuals = false;
  bool record_contacts = false;
  std::optional<scenes::SpacesForm> spaces;
  model::EffectChoices effects;
  int record_every = 1;
  stability::OnBlowup on_blowup = stability::OnBlowup::report;
  ReportFormat report = ReportFormat::text;
  bool no_xdmf = false;
  std::vector<core::NamedPath> paths;  ///< named on the command line
  std::optional<std::string> checkpoint, resume;
  std::optional<double> checkpoint_every_s, max_time_s;
  double budget_s = stepping::default_frame_budget_s;
  int wait_limit_s = 1800;
  CommonOptions common;
  std::string command_line;

  /// The step's length, unless it is left to the scene.
  std::optional<double> dt_s() const {
    return step.has("dt") ? std::optional<double>(step.settings.dt_s) : std::nullopt;
  }
};

/// The step options that FEEC's estimate has in its own version: "estimate-stepper" and so on.
inline constexpr std::array<std::string_view, 3> estimate_options = {"stepper", "iterations", "precision"};

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

/// When a run stops early or is saved, and where.
struct CheckpointSpec {
  std::string path;
  std::optional<double> every_s, max_time_s;
  bool at_end = false;
  std::string resumed_from;      ///< path, or empty
  std::int64_t first_frame = 0;  ///< frames done before this run
};

/// Everything that a run needs to know: options over the scene's defaults.
struct RunSpec {
  int num_worlds = 1;
  int ensemble_worlds = 1;          ///< of the ensemble; the run has all of them, or a range:
  std::optional<WorldRange> range;  ///< num_worlds of them
  int warmup = 3;
  int frames = 5;
  int steps_per_frame = 3;
  std::uint64_t scene_seed = 1;  ///< for the scene's variation; the stepper has its own seed
  stepping::StepperSettings stepper;
  std::optional<EstimateSpec> estimate;                ///< FEEC: how each frame is estimated first
  std::optional<std::string> output;                   ///< path of the HDF5 file, or nothing with --no-output
  std::optional<std::string> sidecar;                  ///< path of ParaView's sidecar, or nothing
  double budget_s = stepping::default_frame_budget_s;  ///< per frame; changes no result
  int record_every = 1;
  bool record_islands = false;
  stability::OnBlowup on_blowup = stability::OnBlowup::report;
  scenes::SpacesForm spaces = scenes::SpacesForm::many;
  Decomposition decomposition =
      Decomposition::automatic;        ///< as asked from resolve(), decided by decompose()
  std::optional<int> ranks_per_world;  ///< as asked, for worlds that are cut
  mpi::RankGroups groups;              ///< with spaces: which ranks cut which worlds; decided by decompose()
  model::EffectChoices effects;        ///< from the scene file and the command line

  CheckpointSpec checkpoint;

  /// The ensemble number of the run's first world.
  int first_world() const { return range ? range->first : 0; }
  /// Counted from the start of the first run, across resumes.
  int total_frames() const { return warmup + frames; }
  std::int64_t frames_to_do() const { return total_frames() - checkpoint.first_frame; }
};

/// Throws core::InputError for impossible values. `num_rows`: of the table of parameters, if there is one.
RunSpec resolve(const Options& options, const scenes::Scene& scene, const ResumePoint& from = {},
                std::optional<int> num_rows = std::nullopt);

/// "3:7": worlds 3 to 6. Throws core::InputError for anything else.
WorldRange parse_world_range(const std::string& text);
std::string to_text(const WorldRange& range);

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

}  // namespace pbmpi::app
