/// The frame loop that all decompositions of the work over ranks share.
#pragma once

#include <atomic>
#include <cstdint>
#include <limits>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "core/clock.h"
#include "mpi/comm/agreement.h"
#include "mpi/comm/communicator.h"
#include "mpi/frame/checkpoint_schedule.h"
#include "mpi/frame/pose_gather.h"
#include "mpi/frame/run_settings.h"
#include "stepping/frame.h"

namespace pbmpi::mpi {

/// Times of one frame: wall_s is equal on every rank, the rest is this rank's own.
struct FrameTimes {
  double wall_s = 0;       ///< root's time from the start of the frame to the end of its gather
  double delivered_s = 0;  ///< with FEEC: root's time until it had the estimate; 0 without
  bool measured = false;
  core::PhaseTimes phases;  ///< as in stepping::FrameRecord: `output` belongs to the frame before
  core::Traffic traffic{};  ///< of this rank
  double processor_s = 0;   ///< as in stepping::FrameRecord
};

/// Seconds that a rank spent on a world.
struct WorldCost {
  int world = 0;
  double seconds = 0;
};

/// Result of a run. Equal on every rank, except `times` (phases are this rank's own) and `rebalance_s`.
struct WorldRunResult {
  std::int64_t frames_done = 0;  ///< warm-up included, and the frames before the run was resumed
  bool stopped = false;          ///< a stop was requested, or the time was up, before the last frame
  std::string failure;  ///< empty, or why the run failed (e.g. "world 17 has 3 non-finite bodies in frame 4")
  std::uint64_t state_hash = 0;   ///< over all bodies in (world, body) order
  std::vector<FrameTimes> times;  ///< [frames_done - first_frame]
  std::string save_failure;       ///< why the snapshot that ends the run could not be stored; else empty
  int num_rebalances = 0;
  std::int64_t worlds_moved = 0;  ///< worlds, or spaces of worlds that are cut
  double rebalance_s = 0;  ///< time that this rank spent moving work between frames; not part of any wall_s
};

/// The state hash of a run from the hashes of its worlds [num_worlds], in order of world: independent of
/// their owners.
std::uint64_t combine_world_hashes(std::span<const std::uint64_t> world_hashes);

/// Collective. The state hash on every rank, from the hashes of each rank's own worlds, `own`, by ascending
/// world; only root holds the hashes of all. `owner` [num_worlds]: the same on every rank.
std::uint64_t gather_state_hash(const Communicator& comm, std::span<const int> owner,
                                std::span<const std::uint64_t> own);

/// Runs the frames of a run on all ranks, which construct and run it together. The communicator is
/// duplicated. The derived class, one for each decomposition, decides how a frame is stepped.
///
/// A frame is: perhaps estimate -> advance -> agree (one allreduce of 6 numbers: stop, save, error,
/// non-finite, guards) -> perhaps settle what guards found -> gather -> verdict (one bcast of 32 bytes: the
/// frame's times, whether work moves, whether the run is saved or its time is up) -> publish (observers,
/// consumers) -> perhaps rebalance -> perhaps save.
class FrameDriver {
 public:
  virtual ~FrameDriver() = default;
  FrameDriver(const FrameDriver&) = delete;
  FrameDriver& operator=(const FrameDriver&) = delete;

  /// Observers see every frame on every rank; consumers get all poses on root. Borrowed: they must outlive
  /// run().
  void add_observer(stepping::FrameObserver& observer);
  void add_consumer(stepping::PoseConsumer& consumer);
  /// Polled once a frame; set it (to the signal's number) from a signal handler. Ranks agree on it in the
  /// frame's own collective.
  void set_stop_flag(const std::atomic<int>& flag);

  /// Has snapshots of the run stored by `keeper` (borrowed), between frames. On every rank or on none.
  void save_to(SnapshotKeeper& keeper, const CheckpointPlan& plan);
  /// Ends the run after the frame in which root's core::now_s() passes this.
  void set_time_limit(double until_s) { until_s_ = until_s; }

  virtual const stepping::WorldTable& table() const = 0;
  /// The worlds that this rank reports, by ascending id.
  virtual std::vector<stepping::LocalWorld> local_worlds() const = 0;

  /// Seconds that this rank spent in the last frame on each world that it steps, alone or with other ranks.
  virtual std::vector<WorldCost> costs() const = 0;

  /// Collective. Ranks that own no bodies, ascending; the same on every rank.
  virtual std::vector<int> idle_ranks() const = 0;

  /// To be called once. An error that a stepper or observer throws on one rank is thrown on every rank: a
  /// stepper's in the same frame, an observer's in the next one or at the end.
  WorldRunResult run();

 protected:
  /// Throws core::InputError for settings that make no sense; `num_parts`: worlds, or spaces, to place.
  FrameDriver(const Communicator& comm, WorldRunSettings settings, int num_parts);

  const Communicator& comm() const { return comm_; }
  const WorldRunSettings& settings() const { return settings_; }
  /// The first error of this rank that the other ranks do not know of yet.
  ErrorHold& errors() { return errors_; }
  /// Has each frame estimated first (FEEC): calls compute_estimate(), and gathers the poses of all bodies of
  /// `table` (borrowed) for root's consumers while the other ranks advance. Called on every rank or on none.
  void gather_estimates(const stepping::WorldTable& table, std::span<const int> placement);
  /// To be called after worlds have moved.
  void place_estimates(std::span<const int> placement) {
    if (estimates_) estimates_->set_placement(placement);
  }

 private:
  /// Estimates frame `frame`, which is to come. Returns the worlds that this rank reports, by ascending id,
  /// with their estimated states; valid until the next call. Errors are held in errors().
  virtual std::span<const stepping::LocalWorld> compute_estimate(std::int64_t frame,
                                                                 core::PhaseTimes& times) {
    static_cast<void>(frame), static_cast<void>(times);
    return {};
  }
  /// This rank's worlds with their profiles (settings().profile); outside of the frame's time.
  virtual std::vector<stepping::LocalWorld> profiled_worlds() { return local_worlds(); }
  /// Does the steps of a frame. Errors are held in errors(), and messages are exchanged regardless.
  virtual void advance(core::PhaseTimes& times) = 0;
  /// Lowest world that this rank reports with a non-finite body; num_worlds if there is none.
  virtual int lowest_nonfinite_world() const = 0;
  virtual std::int64_t count_nonfinite(int world) const = 0;  ///< on the rank that reports the world
  /// Events that guards found in the frame, on the rank that reports the world.
  virtual std::vector<stepping::RunEvent> take_events() { return {}; }
  /// Collective, in a frame in which guards found something, before gather().
  virtual void settle_events() {}
  virtual int reporter_of(int world) const = 0;  ///< the rank that reports the world
  virtual void gather(core::PhaseTimes& times) = 0;
  virtual std::span<const core::Vec3> position() const = 0;  ///< gathered positions of all bodies, on root
  virtual std::span<const core::Quat> orientation() const = 0;
  /// On root, after gather(): plans the moves and returns their number. `last`: no frame follows.
  virtual std::int64_t plan_moves(bool last) = 0;
  /// Collective. Makes the moves planned on root, between two frames; returns one line that describes them.
  virtual std::string make_moves(std::int64_t num_moves, std::int64_t step) = 0;
  virtual std::uint64_t state_hash() const = 0;  ///< collective
  /// Collective. The states of all worlds after the frame, [num_worlds], on root.
  virtual std::vector<model::State> gather_states() const = 0;
  virtual core::Traffic take_traffic() { return {}; }  ///< messages and bytes since the last call

  /// What the ranks agree on after they advanced.
  struct Status {
    int stop = 0;                    ///< the stop flag
    std::int64_t save_requests = 0;  ///< number of requests so far
    int nonfinite_world = -1;        ///< lowest world with a non-finite body
    bool guards_found = false;       ///< a guard found something, on any rank
    bool fails(const WorldRunSettings& settings) const {
      return nonfinite_world >= 0 || (guards_found && settings.stop_at_blowup);
    }
  };
  /// Root's decisions after gather().
  struct Verdict {
    double wall_s = 0;
    double delivered_s = 0;
    std::int64_t num_moves = 0;
    std::int32_t saves = 0;       ///< the run is saved after this frame
    std::int32_t time_is_up = 0;  ///< set_time_limit()
  };

  void run_frame();
  double make_estimate(double frame_start_s, core::PhaseTimes& times);
  const stepping::EstimateRecord* finish_estimate(double delivered_s);
  void hand_to_consumers(std::int64_t frame, stepping::PoseKind kind, std::span<const core::Vec3> position,
                         std::span<const core::Quat> orientation);
  Status agree_on_status();
  Verdict decide(double frame_start_s, double delivered_s, const Status& status);
  void end_early(const std::string& kind, const std::string& why, int value = 0);
  void save(std::int64_t step);
  void publish(const stepping::FrameRecord& frame);
  void rebalance(std::int64_t num_moves, std::int64_t step);
  void note_failure(int world);
  void announce(const stepping::RunEvent& event);
  void announce_breaks(std::span<const stepping::LocalWorld> worlds);
  void announce_guards();
  std::int64_t num_frames() const { return settings_.warmup + settings_.frames; }

  Communicator comm_;
  WorldRunSettings settings_;
  std::vector<stepping::FrameObserver*> observers_;
  std::vector<stepping::PoseConsumer*> consumers_;
  const std::atomic<int>* stop_flag_ = nullptr;
  const std::atomic<int>* save_requests_ = nullptr;
  SnapshotKeeper* keeper_ = nullptr;
  std::optional<CheckpointSchedule> schedule_;  ///< only with a keeper; used on root
  double until_s_ = std::numeric_limits<double>::infinity();
  ErrorHold errors_;
  std::optional<PoseGather> estimates_;         ///< with FEEC
  stepping::EstimateRecord estimate_;           ///< of this frame
  std::int64_t frame_ = 0;                      ///< frames done, including those before the run was resumed
  bool joints_break_ = false;                   ///< the effect "breakable_joints", in any world
  std::vector<stepping::RunEvent> own_events_;  ///< events of this frame, from guards
  double last_output_s_ = 0;  ///< time that observers and consumers took in the previous frame
  WorldRunResult result_;
};

}  // namespace pbmpi::mpi
