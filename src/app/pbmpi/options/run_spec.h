/// What a run of pbmpi is: its options, settled by the scene, and what follows from them.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "model/model.h"
#include "mpi/spaces/plan/rank_groups.h"
#include "scenes/scene.h"
#include "stability/on_blowup.h"
#include "stepping/frame.h"
#include "stepping/stepper.h"

namespace pbmpi::app {

enum class ReportFormat { text, full, json };
enum class Decomposition { automatic, worlds, spaces };
inline constexpr std::array<std::string_view, 3> report_format_names = {"text", "full", "json"};
inline constexpr std::array<std::string_view, 3> decomposition_names = {"auto", "worlds", "spaces"};

/// Worlds first .. end - 1 of an ensemble.
struct WorldRange {
  int first = 0, end = 0;
};

/// "3:7": worlds 3 to 6. Throws core::InputError, opening with `what`, for anything else.
WorldRange parse_world_range(const std::string& text, const std::string& what);
std::string to_text(const WorldRange& range);

/// What a run records beside the bodies and the times of its frames.
enum class Record { islands, contacts, residuals };
inline constexpr std::array<std::string_view, 3> record_names = {"islands", "contacts", "residuals"};

/// Which of them, indexed by Record.
struct Records {
  std::array<bool, record_names.size()> chosen{};

  bool has(Record one) const { return chosen[static_cast<std::size_t>(one)]; }
};

/// "contacts,residuals". Throws core::InputError, opening with `what`, for a word that is none of
/// record_names.
Records parse_records(const std::string& text, const std::string& what);
std::string to_text(const Records& records);

/// When a run stops early or is saved, and where.
struct CheckpointSpec {
  std::string path;
  std::string resumed_from;      ///< path, or empty
  std::int64_t first_frame = 0;  ///< frames done before this run
};

/// Members up to `resume` are those of run_options(): as given on a command line, or once resolve() has
/// filled in what the scene proposes.
struct RunSpec {
  std::optional<std::string> scene;
  int replicas = 1;  ///< worlds of the ensemble
  std::optional<std::string> parameters;
  std::optional<WorldRange> range;  ///< of the ensemble's worlds
  int frames = 5;
  int warmup = 3;
  std::uint64_t seed = 1;  ///< for the scene's variation; the stepper has its own seed
  model::EffectChoices effects;

  int steps_per_frame = 3;
  stability::OnBlowup on_blowup = stability::OnBlowup::report;

  Decomposition decomposition = Decomposition::automatic;  ///< decided by decompose()
  std::optional<int> ranks_per_world;                      ///< of worlds that are cut

  std::optional<std::string> output;  ///< nothing: no file is written
  bool no_output = false, no_xdmf = false;
  int record_every = 1;
  Records records;
  ReportFormat report = ReportFormat::text;
  double budget_s = stepping::default_frame_budget_s;  ///< per frame; changes no result

  std::optional<double> max_time_s;
  std::optional<std::string> checkpoint_file;
  std::optional<double> checkpoint_every_s;
  std::optional<std::string> resume;

  // What follows from them.
  int num_worlds = 1;  ///< all of the ensemble, or those of the range
  stepping::StepperSettings stepper;
  std::optional<stepping::StepperSettings> estimate;  ///< FEEC: how each frame is estimated first
  std::optional<std::string> sidecar;                 ///< path of ParaView's sidecar
  mpi::RankGroups groups;  ///< with spaces: which ranks cut which worlds; decided by decompose()
  CheckpointSpec checkpoint;

  /// The ensemble number of the run's first world.
  int first_world() const { return range ? range->first : 0; }
  /// Counted from the start of the first run, across resumes.
  int total_frames() const { return warmup + frames; }
  std::int64_t frames_to_do() const { return total_frames() - checkpoint.first_frame; }
};

}  // namespace pbmpi::app
