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

/// Root finds the contacts across spaces, from what the ranks sent at the end of the step before, and sends
/// each rank a verdict: is there any such contact? A rank sends the boxes of its spaces, and the states of
/// the bodies of those alone that may touch another rank's in the next step: the verdict before names spaces
/// whose boxes do so if they go on to grow as they did, and spaces with a launch are among them. Where a box
/// reaches another's against expectation, root asks for the states of that space before its verdict.
/// Messages: a border to root after each step (except the last of a frame, where FrameReport sends all
/// states), and a verdict to each rank in each step.
///
/// With sleepers, and where rules change velocities between steps, every space is sent.
///
/// Called by SpaceStep, in the order of a step: start_step(), search_early(), finds_any(), note_pace(),
/// post_border(). With the effect "sleeping", SleepAgreement calls search() once for each round of waking,
/// instead of search_early(). Where nothing can cross, all of this is left out, and require_apart() checks
/// once a frame that the scene's promise holds.
class CrossingSearch {
 public:
  /// `shared` is borrowed.
  explicit CrossingSearch(StepContext& shared) : shared_(&shared), schedule_(1) {}

  /// Takes in new owners of the spaces; every rank has the whole state.
  void own();
  void start_step() { has_verdict_ = false; }
  /// On root, before its own collision: finds contacts and sends the verdict if all borders have arrived, or
  /// are due so soon that waiting for them makes the step shorter (RootSchedule). Does nothing on other
  /// ranks, where nothing can cross, or with sleepers.
  void search_early(std::int64_t step, core::LapTimer& timer);
  /// On root: finds the contacts across spaces, and first receives what is still to come. To be
  /// called again in a step in which more bodies have woken.
  void search(std::int64_t step, core::LapTimer& timer);
  /// On every rank: does anything touch across spaces? Root searches unless it already has, and sends the
  /// verdict; the other ranks wait for it.
  bool finds_any(std::int64_t step, core::LapTimer& timer);
  /// The step has been solved; the arguments say when its collision began and ended (core::now_s()).
  void note_pace(double began_s, double collided_s);
  /// On ranks other than root, at the end of a step: posts what root needs in step `next_step` without
  /// waiting.
  void post_border(std::int64_t next_step);
  /// Nothing moves in this step, so there is no contact. Root receives the messages sent before the last
  /// island fell asleep.
  void skip_step(std::int64_t step, core::LapTimer& timer);

  /// The contacts across spaces, in canonical order, on root; empty on other ranks.
  std::span<const model::Contact> contacts() const { return contacts_; }

  /// [num_spaces] on root.
  std::span<const geometry::Box> boxes() const { return boxes_; }
  /// On root, at the end of a frame: stores the boxes [its spaces] that another rank's account brings.
  void put_boxes(int rank, std::span<const geometry::Box> boxes);
  /// On root: all rows of the state are current, and no borders are awaited in the next step.
  void note_whole_state();
  /// On root: throws core::RunError if bodies touch across spaces although the scene says that they never do.
  void require_apart();
  std::vector<geometry::Box> own_boxes() const;  ///< [own spaces] in the present state

 private:
  enum class Verdict : std::int32_t { apart, touching, more };

  bool borders_have_arrived();
  void receive_borders(std::int64_t step, core::LapTimer& timer);
  void send_verdict(std::int64_t step, core::LapTimer& timer);
  void post(Verdict verdict, int rank, std::span<const std::int32_t> spaces) const;
  void find_contacts();
  /// The launches of the step, and where bodies of other ranks may get with them.
  void launch_others(std::int64_t step);
  /// Asks for the states of spaces that a box now reaches, and waits for them.
  void fetch_missing(core::LapTimer& timer);
  /// Decides which spaces are sent after this step.
  void watch_next();
  /// The spaces of a rank that are sent before a step, ascending.
  std::vector<std::int32_t> sent_spaces(int rank, std::int64_t step) const;
  std::vector<int> launched_spaces(std::int64_t step) const;  ///< with a launch in this step, one for each
  /// Those of its spaces whose flag [num_spaces] is set, ascending.
  std::vector<std::int32_t> spaces_of(int rank, std::span<const char> flags) const;
  std::vector<int> bodies_of(std::span<const std::int32_t> spaces) const;

  StepContext* shared_;
  bool sends_all_ = false;
  std::vector<char>
      watched_;           ///< [num_spaces] is it sent after each step? On root of all ranks, else own ones
  StepPace pace_;         ///< of this rank's last step
  double verdict_s_ = 0;  ///< when this rank last learned whether anything crosses

  // On root only.
  RootSchedule schedule_;
  double unseen_s_ = 0;           ///< when a border was last looked for and had not yet arrived
  double began_s_ = 0;            ///< when the last search began
  bool has_verdict_ = false;      ///< sent in this step
  bool has_borders_ = false;      ///< those of all ranks are in the state
  std::vector<char> is_current_;  ///< [num_spaces] are its rows of the state?
  std::vector<geometry::Box> boxes_, last_boxes_;  ///< [num_spaces] of this step, and of the step before
  std::vector<model::Contact> contacts_;
};

}  // namespace pbmpi::mpi
