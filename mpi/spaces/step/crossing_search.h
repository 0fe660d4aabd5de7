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
/// (except the last of a frame, whose account brings them: FrameReport), a verdict to each rank in each step.
///
/// Called by SpaceStep, in the order of a step: start_step(), search_early(), finds_any(), note_pace(),
/// post_poses(). With the effect "sleeping" SleepAgreement calls search(), once for each round of waking,
/// instead of search_early(). Where nothing can cross all of it is left out, and require_apart() checks once
/// a frame that the scene was right about that.
class CrossingSearch {
 public:
  /// `shared` is borrowed.
  explicit CrossingSearch(StepContext& shared) : shared_(&shared), schedule_(1) {}

  /// The spaces have new owners, and every rank has the whole state.
  void own();
  void start_step() { has_verdict_ = false; }
  /// On root, before its own collision: finds contacts and sends the verdict if all poses have arrived, or
  /// are due so soon that waiting for them makes the step shorter (RootSchedule). Does nothing on other
  /// ranks, where nothing can cross, and with sleepers.
  void search_early(std::int64_t step, core::LapTimer& timer);
  /// On root: finds the contacts across spaces; receives the poses first if they are still to come. To be
  /// called again in a step in which more bodies have woken.
  void search(std::int64_t step, core::LapTimer& timer);
  /// On every rank: does anything touch across spaces? Root searches unless it has, and sends the verdict;
  /// the others wait for it.
  bool finds_any(std::int64_t step, core::LapTimer& timer);
  /// The step has been solved: when its collision began and ended (core::now_s()).
  void note_pace(double began_s, double collided_s);
  /// On ranks other than root, at the end of a step: own poses and boxes to root, without waiting.
  void post_poses();
  /// Nothing moves in this step: there is no contact. Root receives what was sent before the last island fell
  /// asleep.
  void skip_step(core::LapTimer& timer);

  /// On root: contacts across spaces, in canonical order; empty on other ranks.
  std::span<const model::Contact> contacts() const { return contacts_; }

  /// On root, at the end of a frame, when another rank's account brings its boxes, [its spaces].
  void put_boxes(int rank, std::span<const geometry::Box> boxes);
  /// On root: all rows of the state are current, so that no poses are awaited in the next step.
  void note_whole_state() { has_poses_ = true; }
  /// On root: throws core::RunError if bodies touch across spaces, though the scene says that they never do.
  void require_apart();
  std::vector<geometry::Box> own_boxes() const;  ///< [own spaces] at the poses of now

 private:
  bool poses_have_arrived();
  void receive_poses(core::LapTimer& timer);
  void send_verdict(std::int64_t step, core::LapTimer& timer);
  void find_contacts();

  StepContext* shared_;
  StepPace pace_;         ///< of this rank's last step
  double verdict_s_ = 0;  ///< when this rank last knew whether anything crosses

  // On root only.
  RootSchedule schedule_;
  double unseen_s_ = 0;               ///< when a message of poses was last looked for and had not arrived
  double began_s_ = 0;                ///< when the last search began
  bool has_verdict_ = false;          ///< sent in this step
  bool has_poses_ = false;            ///< the poses of all ranks are in the state
  std::vector<geometry::Box> boxes_;  ///< [num_spaces]
  std::vector<model::Contact> contacts_;
};

}  // namespace pbmpi::mpi
