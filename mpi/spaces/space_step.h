/// One step of one world over the ranks that own its spaces.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "core/clock.h"
#include "geometry/box.h"
#include "mpi/comm/agreement.h"
#include "mpi/comm/communicator.h"
#include "mpi/comm/mail.h"
#include "mpi/comm/message.h"
#include "mpi/spaces/island_plan.h"
#include "mpi/spaces/root_schedule.h"
#include "mpi/spaces/space_ownership.h"
#include "mpi/spaces/wire.h"
#include "stepping/space_stepper.h"

namespace pbmpi::mpi {

/// What root learns of the last step of a frame.
struct FrameFindings {
  stepping::Observables seen;    ///< joined over all ranks; not what root measures of all bodies
  std::vector<int> island;       ///< [num_units] lowest unit of its island
  std::vector<double> weight;    ///< [num_units] rows of joints and contacts, and bodies
  std::vector<char> near;        ///< [num_units] with a field of interest: has it a body of the island?
  std::vector<double> energy_j;  ///< [num_bodies]
  std::vector<core::PhaseTimes> times;  ///< [num_ranks] of this frame so far
  std::int64_t bodies_shipped = 0;      ///< in this frame, from any rank to another, step by step
};

/// Collective calls, one step a call. On a rank of its own, and where nothing can cross (all bodies on one
/// rank, or spaces that by the scene's word never meet), a step sends no message and builds no island.
///
/// Otherwise a step is, on every rank: events; collide in own spaces. Root, which has the poses and boxes
/// that the ranks sent at the end of the step before, finds the contacts across spaces, before its own
/// collision if all has arrived by then, and tells the ranks whether there are any. If so, each rank forms
/// its islands from joints and own contacts and reports them; root joins them and tells each rank which to
/// pass on, which to expect, and which contacts across spaces are its own; islands are shipped, and shipped
/// back when they are solved. Where nothing crosses, a rank thus goes on without having to wait for root.
///
/// With the effect "sleeping" the ranks agree, after collision, on the islands that wake and, at the end, on
/// those that fall asleep (space_step_sleep.cpp); while all sleep a step sends nothing.
///
/// With the effect "field_of_interest" that follows a body the owner of that body tells the others where it
/// is (space_step_focus.cpp). Who solves an island finds out for itself whether it is inside.
///
/// With the effect "breakable_joints" what is broken travels with the states of the bodies that it held.
///
/// Errors of the stepper are held in `errors`; the messages of the step are exchanged all the same.
class SpaceStep {
 public:
  /// All borrowed.
  SpaceStep(const Communicator& comm, stepping::SpaceStepper& stepper, ErrorHold& errors);

  /// The spaces have these owners from now on. `state`: of all bodies, on every rank.
  void own(const SpaceOwnership& ownership, const model::State& state, std::int64_t step);

  /// `last` of a frame: root then has all rows of the state, and findings().
  void run(std::int64_t step, bool last, core::PhaseTimes& times);

  const FrameFindings& findings() const { return findings_; }  ///< on root
  /// The contacts that this rank solved in the last step, in canonical order.
  std::span<const model::Contact> contacts() const { return contacts_; }
  core::Traffic take_traffic() { return mail_ ? mail_->take_traffic() : core::Traffic{}; }

 private:
  enum Tag { poses_tag = 1, verdict_tag, report_tag, orders_tag, ship_tag, back_tag, frame_tag, center_tag };
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
  bool learn_of_crossing(std::int64_t step, core::LapTimer& timer);
  bool sleeps_on(std::int64_t step);
  void sleep_on(bool last, core::PhaseTimes& times);
  void wake_touched(std::int64_t step, core::LapTimer& timer);
  void settle(core::LapTimer& timer);
  std::vector<effects::Resting> join_resting(std::span<const effects::Resting> resting);
  void post_center();
  void take_center(core::LapTimer& timer);
  void weigh_outside();
  void find_local_islands();
  void look_across(std::int64_t step, core::LapTimer& timer);
  bool poses_are_here();
  void look_early(std::int64_t step, core::LapTimer& timer);
  void find_crossing(std::int64_t step, core::LapTimer& timer);
  Orders direct(core::LapTimer& timer);
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
  /// What a rank measures of its own bodies at the end of a frame.
  struct Measures {
    stepping::Observables seen;
    std::vector<double> energy_j;  ///< [own bodies]
  };
  Measures measure();
  void finish_frame(core::PhaseTimes& times);
  void post_frame(const Measures& own, const core::PhaseTimes& times);
  void receive_frame(const Measures& own, const core::PhaseTimes& times, core::LapTimer& timer);
  void note_measures(int rank, const stepping::Observables& seen, std::span<const double> energy_j);
  void require_apart();
  void take_frame(int rank, MessageReader& message);
  void note_weights(int rank, std::span<const std::int32_t> weights);
  void note_near(int rank, std::span<const char> near);
  void join_near();
  void join_findings(std::span<const std::vector<std::int32_t>> islands);
  std::vector<geometry::Box> own_boxes() const;

  const Communicator* comm_;
  stepping::SpaceStepper* stepper_;
  ErrorHold* errors_;
  effects::SpaceSleepers* sleepers_;  ///< null without the effect "sleeping"
  effects::FieldOfInterest* field_;   ///< null without the effect "field_of_interest"
  std::optional<SpaceOwnership> ownership_;
  std::unique_ptr<Mail> mail_;    ///< none where no message is sent
  bool crosses_ = false;          ///< can anything cross?
  bool has_fast_bodies_ = false;  ///< the pass of that name
  bool joints_break_ = false;     ///< the pass "breakable_joints"
  std::vector<model::Contact> contacts_;
  std::vector<int> active_units_;          ///< solved here in this step, ascending
  bool has_islands_ = false;               ///< are those of this step found?
  LocalIslands islands_;                   ///< of this rank
  std::vector<std::int32_t> unit_weight_;  ///< [own units] rows of joints and own contacts, and bodies
  std::vector<char> unit_near_;      ///< [own units] with a field of interest: has it a body of the unit?
  std::int64_t bodies_shipped_ = 0;  ///< by this rank in this frame
  std::vector<effects::BodyPair>
      touching_;  ///< with sleepers: own contacts of the step, before islands are shipped
  std::vector<Shipment> guests_, guests_elsewhere_;
  double collided_s_ = 0;  ///< when this rank's collision of the step was done
  double told_s_ = 0;      ///< when it knew what crosses
  StepPace pace_;          ///< of its last step

  // On root only.
  RootSchedule schedule_{1};
  double unseen_s_ = 0;     ///< when poses were last looked for and not there
  double looked_s_ = 0;     ///< when the look across spaces began
  bool has_told_ = false;   ///< the ranks what crosses, in this step
  bool has_poses_ = false;  ///< all rows of the state are those of now: after own() and a frame's end
  std::vector<geometry::Box> boxes_;      ///< [num_spaces]
  std::vector<LocalIslands> reports_;     ///< [num_ranks]
  std::vector<IslandRef> place_of_unit_;  ///< [num_units]
  std::vector<model::Contact> crossing_;  ///< contacts across spaces, canonical
  FrameFindings findings_;
};

}  // namespace pbmpi::mpi
