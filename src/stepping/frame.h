/// What a rank knows of a finished frame, and the interfaces of those who receive it.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "core/clock.h"
#include "core/traffic.h"
#include "model/model.h"
#include "model/state.h"
#include "stepping/observables.h"
#include "stepping/run_event.h"
#include "stepping/step_contacts.h"
#include "stepping/step_profile.h"

namespace pbmpi::stepping {

/// [s] How long a frame may take, unless a run chooses otherwise: a tenth of one at 30 Hz (paper, section
/// 4.1).
inline constexpr double default_frame_budget_s = 0.1 / 30;

/// Where the bodies of each world lie in the global (world, body) order. Known to every rank.
struct WorldTable {
  std::vector<std::int64_t> body_offset{0};  ///< [num_worlds + 1]; the last entry is the number of bodies

  int num_worlds() const { return static_cast<int>(body_offset.size()) - 1; }
  std::int64_t num_bodies() const { return body_offset.back(); }
};

/// One world that this rank owns.
struct LocalWorld {
  int id = 0;
  const model::Model* model = nullptr;
  const model::State* state = nullptr;
  const Observables* observables = nullptr;
  const StepProfile* profile = nullptr;  ///< null unless the run profiles its frames
  /// The frame's last step; null if the run does not record contacts or the world has stopped.
  const StepContacts* contacts = nullptr;
};

/// The estimate of a frame, available before the precise result (FEEC).
struct EstimateRecord {
  std::span<const LocalWorld> worlds;  ///< this rank's, by ascending id: estimated states, no observables
  double delivered_s = 0;  ///< start of the frame until root had all poses: the same on every rank
  double compute_s = 0;    ///< this rank's time for it
};

/// A finished frame as its rank saw it. Spans and pointers hold until the observer returns.
struct FrameRecord {
  std::int64_t frame = 0;              ///< 0-based, warm-up frames included
  std::int64_t step = 0;               ///< steps done since the start of the simulation
  double time_s = 0;                   ///< simulated time = step x dt
  bool measured = false;               ///< false in a warm-up frame
  std::span<const LocalWorld> worlds;  ///< this rank's, by ascending id
  core::PhaseTimes phases;    ///< of this rank; `output` is the time that observers took in the frame before
  core::Traffic traffic;      ///< of this rank; without what MPI's collectives send
  double processor_s = 0;     ///< processor time of this rank, except for waiting and for `output`
  double wall_s = 0;          ///< start of the frame to the end of its gather: the same on every rank
  bool deadline_met = false;  ///< wall_s within the frame budget: the same on every rank
  const EstimateRecord* estimate = nullptr;  ///< none without FEEC
};

/// Called on every rank in lock step, so that an implementation may do collective work.
class FrameObserver {
 public:
  virtual ~FrameObserver() = default;
  virtual void frame_done(const FrameRecord& frame) = 0;
  /// Called before the run is saved after this frame: what an observer still buffers of the frames so far
  /// must survive a kill, because the run would resume after them.
  virtual void secure() {}
  /// Every rank is told of the same event.
  virtual void event(const RunEvent& event) { static_cast<void>(event); }
};

/// FEEC's two results of a frame. The precise result follows from precise results alone; no step starts from
/// an estimate.
enum class PoseKind { estimate, precise };

/// Called on root only, with all bodies' poses gathered in (world, body) order. With FEEC it is called twice
/// a frame, first for the estimate as soon as it is there, while the other ranks work on the precise result;
/// root's own precise work waits until the call returns.
class PoseConsumer {
 public:
  virtual ~PoseConsumer() = default;
  virtual void poses(std::int64_t frame, PoseKind kind, std::span<const core::Vec3> position,
                     std::span<const core::Quat> orientation) = 0;
};

}  // namespace pbmpi::stepping
