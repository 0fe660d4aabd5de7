#include "mpi/spaces/space_step.h"

#include <algorithm>
#include <memory>

#include "effects/effects.h"
#include "model/islands.h"
#include "mpi/comm/message.h"

namespace pbmpi::mpi {

using core::Phase;
using model::Contact;

SpaceStep::SpaceStep(const Communicator& comm, stepping::SpaceStepper& stepper, ErrorHold& errors)
    : comm_(&comm),
      stepper_(&stepper),
      errors_(&errors),
      sleepers_(stepper.sleepers()),
      field_(stepper.field()) {
  if (comm.size() > 1) mail_ = std::make_unique<Mail>(comm);
}

void SpaceStep::own(const SpaceOwnership& ownership, const model::State& state, std::int64_t step) {
  ownership_ = ownership;
  const effects::StepPlan plan(stepper_->model());
  has_fast_bodies_ = plan.has(effects::EffectId::fast_bodies);
  joints_break_ = plan.has(effects::EffectId::breakable_joints);
  crosses_ = ownership.is_divided() && stepper_->model().spaces_meet;
  active_units_ = own_units();
  guard([&] { stepper_->own(ownership.spaces[comm_->rank()], state, step); });
  if (!is_root()) return;
  has_poses_ = true;
  boxes_.resize(ownership.owner.size());
  for (std::size_t space = 0; space < boxes_.size(); ++space)
    boxes_[space] = stepper_->space_box(static_cast<int>(space));
  schedule_ = RootSchedule(comm_->size());
  reports_.assign(static_cast<std::size_t>(comm_->size()), {});
  place_of_unit_.assign(stepper_->map().unit_of_body.size(), {});
}

void SpaceStep::run(std::int64_t step, bool last, core::PhaseTimes& times) {
  core::LapTimer timer(times);
  has_islands_ = false;
  has_told_ = false;
  guard([&] { stepper_->fire_events(step); });
  if (sleeps_on(step)) return sleep_on(last, times);
  if (field_ != nullptr) post_center();
  if (crosses_ && is_root() && !sleepers_) look_early(step, timer);
  const double began_s = core::now_s();
  guard([&] { stepper_->collide(contacts_); });
  collided_s_ = core::now_s();
  timer.lap(Phase::collide);
  if (field_ != nullptr) take_center(timer);
  if (sleepers_) wake_touched(step, timer);
  if (crosses_) exchange(step, timer);
  guard([&] { stepper_->solve(active_units_, contacts_, step, times); });
  core::LapTimer after(times);
  if (crosses_) ship_back(after);
  pace_ = {collided_s_ - began_s, core::now_s() - std::max(told_s_, collided_s_)};
  if (sleepers_) settle(after);
  if (last) {
    finish_frame(times);
  } else if (crosses_ && !is_root()) {
    post_poses();
    after.lap(Phase::gather);
  }
}

void SpaceStep::exchange(std::int64_t step, core::LapTimer& timer) {
  guests_.clear();
  guests_elsewhere_.clear();
  if (!learn_of_crossing(step, timer)) {
    if (active_units_ != own_units()) active_units_ = own_units();
    return;
  }
  find_local_islands();
  timer.lap(Phase::islands);
  Orders orders;
  if (is_root()) {
    orders = direct(timer);
  } else {
    post_report();
    timer.lap(Phase::gather);
    orders = receive_orders();
    timer.lap(Phase::wait);
  }
  ship(orders, timer);
}

/// Does anything touch across spaces?
bool SpaceStep::learn_of_crossing(std::int64_t step, core::LapTimer& timer) {
  if (is_root()) {
    if (!has_told_) find_crossing(step, timer);
    return !crossing_.empty();
  }
  MessageReader verdict(mail_->take(Communicator::root, verdict_tag));
  timer.lap(Phase::wait);
  told_s_ = core::now_s();
  mail_->finish();  // root had received all of the step before, so that nothing is waited for
  return verdict.get_value<std::int32_t>() != 0;
}

void SpaceStep::find_local_islands() {
  has_islands_ = true;
  const model::SpaceMap& map = stepper_->map();
  model::DisjointSets sets(map.num_units());
  std::vector<std::int32_t> weight(static_cast<std::size_t>(map.num_units()), 0);
  for (const Contact& contact : contacts_) {
    const int unit = map.unit_of_body[contact.body_a];
    weight[unit] += model::contact_rows(contact.mu);
    if (contact.body_b != model::no_body) sets.unite(unit, map.unit_of_body[contact.body_b]);
  }
  std::vector<std::int32_t> island(static_cast<std::size_t>(map.num_units()), -1);
  islands_.of_unit.clear();
  islands_.weight.clear();
  unit_weight_.clear();
  for (const int unit : own_units()) {
    const int lowest = sets.find(unit);
    if (lowest == unit) {
      island[unit] = static_cast<std::int32_t>(islands_.weight.size());
      islands_.weight.push_back(0);
    }
    islands_.of_unit.push_back(island[lowest]);
    unit_weight_.push_back(weight[unit] + map.rows_of_unit[unit] +
                           static_cast<std::int32_t>(map.bodies_of_unit[unit].size()));
    islands_.weight[island[lowest]] += unit_weight_.back();
  }
  if (field_ != nullptr) weigh_outside();
}

void SpaceStep::post_report() {
  MessageWriter message;
  message.put(islands_.of_unit);
  message.put(islands_.weight);
  mail_->post(message.take(), Communicator::root, report_tag);
}

SpaceStep::Orders SpaceStep::receive_orders() {
  MessageReader message(mail_->take(Communicator::root, orders_tag));
  Orders orders;
  const auto outgoing = message.get<std::int32_t>();
  const auto arrivals = message.get<std::int32_t>();
  const auto contacts = message.get<WireContact>();
  orders.outgoing.assign(outgoing.begin(), outgoing.end());
  orders.arrivals.assign(arrivals.begin(), arrivals.end());
  orders.contacts.assign(contacts.begin(), contacts.end());
  return orders;
}

std::vector<geometry::Box> SpaceStep::own_boxes() const {
  std::vector<geometry::Box> boxes;
  for (const int space : ownership_->spaces[comm_->rank()]) boxes.push_back(stepper_->space_box(space));
  return boxes;
}

void SpaceStep::post_poses() {
  MessageWriter message;
  message.put(pose_rows(stepper_->state(), ownership_->bodies[comm_->rank()]));
  message.put(own_boxes());
  message.put_value(pace_);
  if (has_fast_bodies_) {
    std::vector<int> fast;
    guard([&] { fast = stepper_->fast_bodies(); });
    message.put(fast);
    message.put(state_rows(stepper_->state(), fast));
  }
  mail_->post(message.take(), Communicator::root, poses_tag);
}

}  // namespace pbmpi::mpi
