/// What a user reads at the end of a run: one struct, filled from a live run (pbmpi) or from its file
/// (pbreport), and printed as text or JSON. The JSON keys are a contract: more may be added, none renamed.
#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "analysis/error_bands.h"
#include "core/clock.h"
#include "core/statistics.h"
#include "effects/run_plan.h"
#include "mpi/spaces/plan/rank_groups.h"
#include "stepping/observable_table.h"
#include "stepping/run_event.h"

namespace pbmpi::app {

/// Seconds over the measured frames.
struct PhaseSummary {
  std::string name;
  double min_s = 0, avg_s = 0, max_s = 0;
  int min_rank = 0, max_rank = 0;
  std::vector<double> by_rank_s;  ///< [ranks]
};

struct EffectSummary {
  std::string name;
  std::string reason;
};

std::vector<EffectSummary> effect_summaries(const effects::RunPlan& plan);

/// FEEC, over the measured frames. Defects, over all bodies, compare the estimate with the precise pose of
/// the same frame.
struct EstimateSummary {
  std::string stepper, precision = "double";
  int iterations = 1;
  double delivered_p50_s = 0, delivered_p99_s = 0, delivered_max_s = 0;  ///< start of the frame to delivery
  double harmonic_mean_hz = 0, satisfied_fraction = 0;                   ///< over the deliveries
  double precise_over_delivered = 0;       ///< sum of the frames' precise times over that of their deliveries
  analysis::ErrorSummary position_defect;  ///< [m]
  analysis::ErrorSummary orientation_defect;  ///< [rad]
};

/// What limits worlds that are cut into spaces. Work = the useful seconds of all ranks; speed-ups are against
/// one rank that does all of it except root's section, which one rank alone need not do. Groups of ranks do
/// their roots' sections in parallel.
struct SpacesSummary {
  double serial_share = 0;  ///< root's section (cross_space) over the elapsed time that one rank would take
  double amdahl_bound = 1;  ///< speed-up if all but root's section were spread evenly
  double island_bound = 1;  ///< speed-up if, in addition, one rank solved each frame's largest island
  double speed_up = 1;      ///< measured: work over elapsed time
  double messages_per_step = 0, bytes_per_step = 0;  ///< over all ranks
};

/// Processor time of a rank in a frame without waiting, which does not depend on how many ranks share a core;
/// 0 if unknown.
struct ProcessorSummary {
  double busiest_s = 0, mean_s = 0;  ///< of the ranks' means over the measured frames
  int busiest_rank = 0;
};

/// The most memory that a rank needed at once; 0 if unknown.
struct MemorySummary {
  std::int64_t min_bytes = 0, max_bytes = 0;
  int min_rank = 0, max_rank = 0;
};

/// What guards found in the whole run, and what was done about it (--on-blowup).
struct GuardSummary {
  std::map<std::string, std::int64_t> counts;  ///< by stepping::event_kind
  std::string first;                           ///< in words; empty if nothing was found

  void add(const stepping::RunEvent& event);
  std::int64_t count(const std::string& kind) const;
};

/// Counts and invariants over the measured frames; counts are sums over all worlds at the end of a frame.
struct RunSummary {
  std::string version, scene, stepper, precision = "double", simd, output, state_hash;
  std::vector<std::string> hosts;  ///< distinct
  std::vector<int> idle_ranks;     ///< ranks that own no world at the end
  int worlds = 0, ranks = 0, threads = 1, iterations = 0, substeps = 1, steps_per_frame = 0;
  std::int64_t bodies = 0;
  std::uint64_t seed = 0;
  double dt_s = 0, budget_s = 0;
  std::int64_t warmup_frames = 0, measured_frames = 0;
  std::int64_t first_frame = 0;  ///< frames done earlier, by the run that this one resumes
  std::string checkpoint;        ///< the last one written, and after how many frames; empty if none
  bool complete = true;
  double harmonic_mean_hz = 0, satisfied_fraction = 0;
  double world_steps_per_s = 0, body_steps_per_s = 0;
  double frame_p50_s = 0, frame_p95_s = 0, frame_p99_s = 0, frame_max_s = 0;
  std::vector<PhaseSummary> phases;
  double parallel_efficiency = 0, load_balance = 0, communication_efficiency = 0;
  /// What all ranks send each other in a frame: in the steps of worlds that are cut, and to gather poses and
  /// costs of whole worlds. Messages of MPI's collectives are not counted.
  double messages_per_frame = 0, bytes_per_frame = 0;
  ProcessorSummary processor;
  MemorySummary memory;
  core::Summary islands;
  double contacts_mean = 0, contacts_max = 0, rows_mean = 0, rows_max = 0;
  std::int64_t nonfinite_bodies = 0;
  double max_joint_gap_m = 0, max_penetration_m = 0;  ///< largest over the measured frames
  double energy_j = 0;                                ///< of all worlds, at the end
  std::vector<EffectSummary> effects;
  std::string effects_chosen;        ///< "+friction,-gravity": demanded and left out; empty: the scene's own
  std::int64_t worlds_survived = 0;  ///< whose numbers stayed finite and that were not frozen
  std::int64_t joints_broken = 0;    ///< in the whole run
  GuardSummary guards;
  std::int64_t rebalances = 0, worlds_moved = 0;  ///< moved: worlds, or spaces
  std::string decomposition = "worlds";
  mpi::RankGroups groups;                   ///< with "spaces"; none for files of one world
  SpacesSummary spaces;                     ///< only if decomposition is "spaces"
  std::optional<EstimateSummary> estimate;  ///< with FEEC
};

/// The measured part of a run, frame by frame: what the numbers above are computed from.
struct MeasuredFrames {
  std::vector<double> wall_s;                                             ///< [T] frames, measured ones only
  std::vector<std::vector<std::array<double, core::num_phases>>> phases;  ///< [R][T] s
  std::vector<double> islands, contacts, rows;                            ///< [T] sums over worlds
  std::vector<double> max_island_rows;                                    ///< [T] of the largest island
  std::vector<double> messages, bytes;                                    ///< [T] sums over ranks
  std::vector<double> processor_s;  ///< [R] without waiting, over all frames; empty for an older file
};

/// A run's observables, joined over its worlds, from which a summary is made, for a live run as well as for
/// its file. All frames, including the warm-up.
struct ObservedFrames {
  std::vector<bool> measured;  ///< [T] false in a warm-up frame
  /// [columns of stepping::world_observables][T]; empty for vectors, and for columns that an older file
  /// lacks.
  std::vector<std::vector<double>> joined =
      std::vector<std::vector<double>>(stepping::world_observables.size());

  /// [measured frames] of one column; zeros if the column is empty.
  std::vector<double> measured_of(std::size_t column) const;
  /// Value in the last frame, or in the first; 0 without any frame.
  double last(std::size_t column) const;
  double first(std::size_t column) const;
  /// The largest over the measured frames; 0 without any.
  double largest_measured(std::size_t column) const;
};

/// Counts of contacts, rows and islands.
void take_counts(const ObservedFrames& observed, MeasuredFrames& frames);

/// Values that stay small or steady in a sound run: non-finite bodies and energy at the end, joint gap and
/// penetration over the measured frames.
void take_invariants(const ObservedFrames& observed, RunSummary& summary);

/// Fills frame rate, throughput, frame times, phases, efficiency, islands, contacts and rows of `summary`,
/// whose worlds, bodies, ranks, steps_per_frame and budget_s are set.
///
/// Efficiencies follow the POP centre of excellence's model (pop-coe.eu): load balance = mean / max useful
/// time over ranks, communication efficiency = max useful / elapsed time, parallel efficiency = their
/// product.
void compute_performance(const MeasuredFrames& frames, RunSummary& summary);

/// Fills the times of `estimate` from those of the measured frames [T].
void compute_delivery(const std::vector<double>& delivered_s, const std::vector<double>& precise_s,
                      double budget_s, EstimateSummary& estimate);

/// What one asks first, in lines: the work, how fast it was against the budget, how far joints and contacts
/// are off, what failed, the hash. `in_colour`: for a terminal.
std::string to_short_text(const RunSummary& summary, bool in_colour);

/// The whole summary as text, one line a number or group ("state_hash: ...").
std::string to_text(const RunSummary& summary);

/// The JSON document of --report json, with a newline at the end.
std::string to_json(const RunSummary& summary);

}  // namespace pbmpi::app
