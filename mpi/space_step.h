/// One step of one world over the ranks that own its spaces.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "core/clock.h"
#include "model/box.h"
#include "model/space_stepper.h"
#include "mpi/agreement.h"
#include "mpi/communicator.h"
#include "mpi/island_plan.h"
#include "mpi/mail.h"
#include "mpi/message.h"
#include "mpi/space_ownership.h"
#include "mpi/wire.h"

namespace pbmpi::mpi {

/// What root learns of the last step of a frame.
struct FrameFindings {
  model::IslandCounts counts;  ///< over all ranks
  std::vector<int> island;     ///< [num_units] lowest unit of its island
  std::vector<double> weight;  ///< [num_units] rows of joints and contacts, and bodies
  std::vector<char> near;      ///< [num_units] with a field of interest: has it a body of the island?
  std::vector<core::PhaseTimes> times;  ///< [num_ranks] of this frame so far
  std::int64_t bodies_shipped = 0;      ///< in this frame, from any rank to another, step by step
};

/// Collective calls, one step a call. On a rank of its own, and where nothing can cross (all bodies on one
/// rank, or spaces that by the scene's word never meet), a step sends no message and builds no island.
///
/// Otherwise a step is, on every rank: events; collide in own spaces; islands from joints and own contacts;
/// then root, which has the poses and boxes that the ranks sent at the end of the step before, finds the
/// contacts across spaces, joins the islands and tells each rank which of them to pass on, which to expect,
/// and which contacts across spaces are its own; islands are shipped, solved, and shipped back; poses and
/// boxes go to root, which looks at them while the ranks already collide.
///
/// With the effect "sleeping" the ranks agree, after collision, on the islands that wake and, at the end, on
/// those that fall asleep (space_step_sleep.cpp); while all sleep a step sends nothing.
///
/// With the effect "field_of_interest" that follows a body the owner of that body tells the others where it
/// is (space_step_focus.cpp). Who solves an island finds out for itself whether it is inside.
///
/// Errors of the stepper are held in `errors`; the messages of the step are exchanged all the same.
class SpaceStep {
 public:
  /// All borrowed.
  SpaceStep(const Communicator& comm, model::SpaceStepper& stepper, ErrorHold& errors);

  /// The spaces have these owners from now on. `state`: of all bodies, on every rank.
  void own(const SpaceOwnership& ownership, const model::State& state, std::int64_t step);

  /// `last` of a frame: root then has all rows of the state, and findings().
  void run(std::int64_t step, bool last, core::PhaseTimes& times);

  const FrameFindings& findings() const { return findings_; }  ///< on root
  /// The contacts that this rank solved in the last step, in canonical order.
  std::span<const model::Contact> contacts() const { return contacts_; }
  model::Traffic take_traffic() { return mail_ ? mail_->take_traffic() : model::Traffic{}; }

 private:
  enum Tag { poses_tag = 1, report_tag, orders_tag, ship_tag, back_tag, frame_tag, center_tag };
  /// Units of one other rank that are solved here, or of this one that are solved there.
  struct Shipment {
    int rank = 0;
    std::vector<int> units;
  };
  /// What root tells a rank.
  struct Orders {
    std::vector<std::int32_t> outgoing;  ///< pairs: local island, rank
    std::vector<std::int32_t> arrivals;  ///< ranks that send islands
    std::vector<WireContact> contacts;   ///< across spaces, of islands solved by the rank
  };

  template <class Function>
  void guard(Function&& function) {
    if (!errors_->failed()) errors_->guard(std::forward<Function>(function));
  }
  bool is_root() const { return comm_->is_root(); }
  const std::vector<int>& own_units() const { return ownership_->units[comm_->rank()]; }

  void exchange(std::int64_t step, core::LapTimer& timer);
  bool sleeps_on(std::int64_t step);
  void sleep_on(bool last, core::PhaseTimes& times);
  void wake_touched(std::int64_t step, core::LapTimer& timer);
  void settle(core::LapTimer& timer);
  std::vector<model::Resting> join_resting(std::span<const model::Resting> resting);
  void post_center();
  void take_center(core::LapTimer& timer);
  void weigh_outside();
  void find_local_islands();
  void look_across(std::int64_t step, core::LapTimer& timer);
  Orders direct(std::int64_t step, core::LapTimer& timer);
  void receive_poses(core::LapTimer& timer);
  void receive_reports(core::LapTimer& timer);
  std::vector<Orders> join_islands();
  void post_report();
  Orders receive_orders();
  void ship(const Orders& orders, core::LapTimer& timer);
  void ship_out(const Orders& orders);
  void ship_in(const Orders& orders, core::LapTimer& timer);
  void ship_back(core::LapTimer& timer);
  void post_poses();
  void finish_frame(core::PhaseTimes& times);
  void post_frame(const model::IslandCounts& counts, const core::PhaseTimes& times);
  void receive_frame(const model::IslandCounts& counts, const core::PhaseTimes& times, core::LapTimer& timer);
  void require_apart();
  void take_frame(int rank, MessageReader& message);
  void note_weights(int rank, std::span<const std::int32_t> weights);
  void note_near(int rank, std::span<const char> near);
  void join_near();
  void join_findings(std::span<const std::vector<std::int32_t>> islands);
  std::vector<model::Box> own_boxes() const;

  const Communicator* comm_;
  model::SpaceStepper* stepper_;
  ErrorHold* errors_;
  model::SpaceSleepers* sleepers_;  ///< null without the effect "sleeping"
  model::FieldOfInterest* field_;   ///< null without the effect "field_of_interest"
  std::optional<SpaceOwnership> ownership_;
  std::unique_ptr<Mail> mail_;    ///< none where no message is sent
  bool crosses_ = false;          ///< can anything cross?
  bool has_fast_bodies_ = false;  ///< the pass of that name
  std::vector<model::Contact> contacts_;
  std::vector<int> active_units_;          ///< solved here in this step, ascending
  LocalIslands islands_;                   ///< of this rank
  std::vector<std::int32_t> unit_weight_;  ///< [own units] rows of joints and own contacts, and bodies
  std::vector<char> unit_near_;      ///< [own units] with a field of interest: has it a body of the unit?
  std::int64_t bodies_shipped_ = 0;  ///< by this rank in this frame
  std::vector<model::BodyPair>
      touching_;  ///< with sleepers: own contacts of the step, before islands are shipped
  std::vector<Shipment> guests_, guests_elsewhere_;

  // On root only.
  bool has_poses_ = false;         ///< all rows of the state are those of now: after own() and a frame's end
  std::vector<model::Box> boxes_;  ///< [num_spaces]
  std::vector<LocalIslands> reports_;     ///< [num_ranks]
  std::vector<IslandRef> place_of_unit_;  ///< [num_units]
  std::vector<model::Contact> crossing_;  ///< contacts across spaces, canonical
  FrameFindings findings_;
};

}  // namespace pbmpi::mpi
