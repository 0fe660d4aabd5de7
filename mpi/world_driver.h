/// Runs many worlds over the ranks: each rank owns whole worlds and steps them without a message inside a
/// step.
#pragma once

#include <atomic>
#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "core/clock.h"
#include "model/estimator.h"
#include "model/frame.h"
#include "model/stepper.h"
#include "mpi/agreement.h"
#include "mpi/communicator.h"
#include "mpi/owned_worlds.h"
#include "mpi/pose_gather.h"
#include "mpi/rebalancer.h"

namespace pbmpi::mpi {

struct WorldRunSettings {
  int num_worlds = 1;
  int warmup = 3;  ///< frames before the measured ones
  int frames = 5;  ///< measured frames
  int steps_per_frame = 3;
  double dt_s = 0.01;
  double budget_s = 0.1 / 30;        ///< a frame's deadline: 10 % of 1/30 s (paper, section 4.1)
  double rebalance_threshold = 1.1;  ///< worlds move when max/avg useful time passes this; infinity = never
  bool profile = false;        ///< measure the last step of each frame again, after the frame's time is taken
  std::vector<int> placement;  ///< [num_worlds] owner at the start; empty = equal counts, contiguous
};

/// Times of one frame: equal on every rank for wall_s, this rank's for the rest.
struct FrameTimes {
  double wall_s = 0;       ///< root's time from the start of the frame to the end of its gather
  double delivered_s = 0;  ///< with FEEC: until root had the estimate; 0 without
  bool measured = false;
  core::PhaseTimes phases;  ///< as in model::FrameRecord: `output` is that of the frame before
};

/// The same on every rank, except `times` (phases are this rank's own) and `rebalance_s`.
struct WorldRunResult {
  std::int64_t frames_done = 0;  ///< warm-up included
  bool stopped = false;          ///< a stop was requested before the last frame
  std::string failure;  ///< empty, or why the run failed (e.g. "world 17 has 3 non-finite bodies in frame 4")
  std::uint64_t state_hash = 0;   ///< over all bodies in (world, body) order
  std::vector<FrameTimes> times;  ///< [frames_done]
  int num_rebalances = 0;
  std::int64_t worlds_moved = 0;
  double rebalance_s = 0;  ///< time that this rank spent moving worlds, between frames: in no wall_s
};

/// The state hash of a run from the hashes of its worlds [num_worlds], in order of world: independent of who
/// owned which.
std::uint64_t combine_world_hashes(std::span<const std::uint64_t> world_hashes);

/// The frame loop of the worlds decomposition. All ranks construct and run it together. The communicator is
/// duplicated; the stepper is borrowed and holds this rank's worlds, also after the run.
///
/// With an estimator (FEEC) a frame begins with: estimate -> send the estimated poses to root, without
/// waiting -> root waits for them and hands them on, while the other ranks advance. The precise states are
/// the same bits with and without it.
///
/// A frame is: advance (no message) -> agree (one allreduce of 4 numbers: stop, error, non-finite) -> gather
/// (one gatherv of poses and costs) -> verdict (one bcast of 16 bytes: the frame's time, and whether worlds
/// move) -> publish (observers, consumers) -> perhaps rebalance.
class WorldDriver {
 public:
  /// Throws core::InputError for settings that make no sense, and what BuildWorld or the stepper throws.
  WorldDriver(const Communicator& comm, model::WorldStepper& stepper, BuildWorld build,
              WorldRunSettings settings);
  WorldDriver(const WorldDriver&) = delete;
  WorldDriver& operator=(const WorldDriver&) = delete;

  /// Observers see every frame on every rank; consumers get all poses on root. Borrowed: they must outlive
  /// run().
  void add_observer(model::FrameObserver& observer);
  void add_consumer(model::PoseConsumer& consumer);
  /// Estimates every frame first. Borrowed; it must outlive run(). On every rank or on none.
  void set_estimator(model::Estimator& estimator);
  /// Polled once a frame; set it (to the signal's number) from a signal handler. Ranks agree on it in the
  /// frame's own collective.
  void set_stop_flag(const std::atomic<int>& flag);

  const model::WorldTable& table() const { return worlds_.table(); }
  std::vector<model::LocalWorld> local_worlds() const { return worlds_.views(); }  ///< by ascending id
  /// [num_worlds] owner of each world now
  const std::vector<int>& placement() const { return worlds_.placement(); }

  /// Once a driver. What a stepper or observer throws on one rank is thrown on every rank: a stepper's in the
  /// same frame, an observer's in the next one or at the end.
  WorldRunResult run();

 private:
  /// What the ranks agree on after they advanced.
  struct Status {
    int stop = 0;              ///< the stop flag
    int nonfinite_world = -1;  ///< lowest world with a non-finite body
  };
  /// What root decides once it has everything.
  struct Verdict {
    double wall_s = 0;
    double delivered_s = 0;
    std::int64_t num_moves = 0;
  };

  void run_frame();
  /// What this rank knows of a frame's estimate.
  struct Estimate {
    std::vector<model::LocalWorld> worlds;
    model::EstimateRecord record;
  };
  Estimate make_estimate(double frame_start_s, core::PhaseTimes& times);
  void hand_to_consumers(model::PoseKind kind, const PoseGather& poses);
  void advance(core::PhaseTimes& times);
  Status agree_on_status();
  int lowest_nonfinite_world() const;  ///< of this rank's; num_worlds if there is none
  Verdict decide(double frame_start_s, double delivered_s, bool last);
  /// This rank's worlds with their profiles; outside of the frame's time.
  std::vector<model::LocalWorld> profiled_views();
  void publish(const model::FrameRecord& frame);
  void rebalance_worlds(std::int64_t num_moves, std::int64_t step);
  void note_failure(int world);
  void announce(const model::RunEvent& event);
  std::uint64_t state_hash() const;
  std::int64_t num_frames() const { return settings_.warmup + settings_.frames; }

  Communicator comm_;
  model::WorldStepper* stepper_;
  WorldRunSettings settings_;
  OwnedWorlds worlds_;
  PoseGather gather_;
  std::unique_ptr<PoseGather> estimates_;  ///< with an estimator
  Rebalancer rebalancer_;                  ///< used on root
  Rebalancing planned_;                    ///< root: the moves of the last verdict
  std::vector<model::FrameObserver*> observers_;
  std::vector<model::PoseConsumer*> consumers_;
  model::Estimator* estimator_ = nullptr;
  const std::atomic<int>* stop_flag_ = nullptr;
  ErrorHold errors_;
  std::int64_t frame_ = 0;    ///< frames done
  double last_output_s_ = 0;  ///< time that observers and consumers took in the frame before
  WorldRunResult result_;
};

}  // namespace pbmpi::mpi
