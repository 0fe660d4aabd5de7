/// The search for contacts between spaces of different ranks.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "core/clock.h"
#include "geometry/box.h"
#include "mpi/spaces/plan/root_schedule.h"
#include "mpi/spaces/step/step_context.h"

namespace pbmpi::mpi {

/// Root finds the contacts across spaces, from the poses and boxes that the ranks sent at the end of the step
/// before, and sends each rank a verdict: is there any such contact? Messages: poses to root after each step
/// (except the last of a frame, where FrameReport sends them), and a verdict to each rank in each step.
///
/// Called by SpaceStep, in the order of a step: start_step(), search_early(), finds_any(), note_pace(),
/// post_poses(). With the effect "sleeping", SleepAgreement calls search() once for each round of waking,
/// instead of search_early(). Where nothing can cross, all of this is left out, and require_apart() checks
/// once a frame that the scene's promise holds.
class CrossingSearch {
 public:
  /// `shared` is borrowed.
  explicit CrossingSearch(StepContext& shared) : shared_(&shared), schedule_(1) {}

  /// Takes in new owners of the spaces; every rank has the whole state.
  void own();
  void start_step() { has_verdict_ = false; }
  /// On root, before its own collision: finds contacts and sends the verdict if all poses have arrived, or
  /// are due so soon that waiting for them makes the step shorter (RootSchedule). Does nothing on other
  /// ranks, where nothing can cross, or with sleepers.
  void search_early(std::int64_t step, core::LapTimer& timer);
  /// On root: finds the contacts across spaces, and first receives the poses that are still to come. To be
  /// called again in a step in which more bodies have woken.
  void search(std::int64_t step, core::LapTimer& timer);
  /// On every rank: does anything touch across spaces? Root searches unless it already has, and sends the
  /// verdict; the other ranks wait for it.
  bool finds_any(std::int64_t step, core::LapTimer& timer);
  /// The step has been solved; the arguments say when its collision began and ended (core::now_s()).
  void note_pace(double began_s, double collided_s);
  /// On ranks other than root, at the end of a step: posts own poses and boxes to root without waiting.
  void post_poses();
  /// Nothing moves in this step, so there is no contact. Root receives the messages sent before the last
  /// island fell asleep.
  void skip_step(core::LapTimer& timer);

  /// The contacts across spaces, in canonical order, on root; empty on other ranks.
  std::span<const model::Contact> contacts() const { return contacts_; }

  /// On root, at the end of a frame: stores the boxes [its spaces] that another rank's account brings.
  void put_boxes(int rank, std::span<const geometry::Box> boxes);
  /// On root: all rows of the state are current, and no poses are awaited in the next step.
  void note_whole_state() { has_poses_ = true; }
  /// On root: throws core::RunError if bodies touch across spaces although the scene says that they never do.
  void require_apart();
  std::vector<geometry::Box> own_boxes() const;  ///< [own spaces] at the present poses

 private:
  bool poses_have_arrived();
  void receive_poses(core::LapTimer& timer);
  void send_verdict(std::int64_t step, core::LapTimer& timer);
  void find_contacts();

  StepContext* shared_;
  StepPace pace_;         ///< of this rank's last step
  double verdict_s_ = 0;  ///< when this rank last learned whether anything crosses

  // On root only.
  RootSchedule schedule_;
  double unseen_s_ = 0;               ///< when a message of poses was last looked for and had not yet arrived
  double began_s_ = 0;                ///< when the last search began
  bool has_verdict_ = false;          ///< sent in this step
  bool has_poses_ = false;            ///< the poses of all ranks are in the state
  std::vector<geometry::Box> boxes_;  ///< [num_spaces]
  std::vector<model::Contact> contacts_;
};

}  // namespace pbmpi::mpi
