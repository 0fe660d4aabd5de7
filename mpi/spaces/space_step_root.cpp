/// Root's section of a step: what crosses spaces.
#include "mpi/spaces/space_step.h"

#include <utility>

namespace pbmpi::mpi {

using core::Phase;
using model::Contact;

/// Finds the contacts across spaces; again, once more bodies are awake.
void SpaceStep::look_across(std::int64_t step, core::LapTimer& timer) {
  if (!has_poses_) receive_poses(timer);
  has_poses_ = true;
  looked_s_ = core::now_s();
  guard([&] {
    stepper_->launch_others(step, boxes_);
    for (const int space : ownership_->spaces[comm_->rank()]) boxes_[space] = stepper_->space_box(space);
    stepper_->collide_across(ownership_->owner, boxes_, crossing_);
  });
  timer.lap(Phase::cross_space);
}

bool SpaceStep::poses_are_here() {
  if (has_poses_) return true;
  for (int rank = 1; rank < comm_->size(); ++rank) {
    if (mail_->has(rank, poses_tag)) continue;
    unseen_s_ = core::now_s();
    return false;
  }
  return true;
}

/// Before root's own collision, if the poses are there by then or due.
void SpaceStep::look_early(std::int64_t step, core::LapTimer& timer) {
  schedule_.note_own(pace_);
  if (has_poses_) schedule_.start_all(core::now_s());
  bool here = poses_are_here();
  while (!here && schedule_.should_wait(unseen_s_)) here = poses_are_here();
  timer.lap(Phase::wait);
  if (here) find_crossing(step, timer);
}

/// Root's section of the step as far as it needs no report, and its verdict.
void SpaceStep::find_crossing(std::int64_t step, core::LapTimer& timer) {
  if (sleepers_ == nullptr) look_across(step, timer);
  has_poses_ = false;
  has_told_ = true;
  mail_->finish();  // the ranks have received all of the step before, so that nothing is waited for
  told_s_ = core::now_s();
  schedule_.told(told_s_, told_s_ - looked_s_);
  for (int rank = 1; rank < comm_->size(); ++rank) {
    MessageWriter message;
    message.put_value(static_cast<std::int32_t>(crossing_.empty() ? 0 : 1));
    mail_->post(message.take(), rank, verdict_tag);
  }
  timer.lap(Phase::cross_space);
}

/// The rest of root's section, where something crosses.
SpaceStep::Orders SpaceStep::direct(core::LapTimer& timer) {
  receive_reports(timer);
  std::vector<Orders> orders = join_islands();
  for (int rank = 1; rank < comm_->size(); ++rank) {
    MessageWriter message;
    message.put(orders[rank].outgoing);
    message.put(orders[rank].arrivals);
    message.put(orders[rank].contacts);
    mail_->post(message.take(), rank, orders_tag);
  }
  timer.lap(Phase::cross_space);
  return std::move(orders.front());
}

void SpaceStep::receive_poses(core::LapTimer& timer) {
  for (int rank = 1; rank < comm_->size(); ++rank) {
    MessageReader message(mail_->take(rank, poses_tag));
    timer.lap(Phase::wait);
    stepper_->put_poses(ownership_->bodies[rank], message.get<double>());
    const std::span<const geometry::Box> boxes = message.get<geometry::Box>();
    for (std::size_t i = 0; i < boxes.size(); ++i) boxes_[ownership_->spaces[rank][i]] = boxes[i];
    schedule_.arrived(rank, unseen_s_, core::now_s(), message.get_value<StepPace>());
    if (has_fast_bodies_) {
      const std::span<const int> fast = message.get<int>();
      stepper_->put_states(fast, message.get<double>());
    }
    timer.lap(Phase::gather);
  }
}

void SpaceStep::receive_reports(core::LapTimer& timer) {
  reports_[comm_->rank()] = islands_;
  for (int rank = 1; rank < comm_->size(); ++rank) {
    MessageReader message(mail_->take(rank, report_tag));
    timer.lap(Phase::wait);
    const auto of_unit = message.get<std::int32_t>();
    const auto weight = message.get<std::int32_t>();
    reports_[rank].of_unit.assign(of_unit.begin(), of_unit.end());
    reports_[rank].weight.assign(weight.begin(), weight.end());
  }
  timer.lap(Phase::gather);
}

std::vector<SpaceStep::Orders> SpaceStep::join_islands() {
  const model::SpaceMap& map = stepper_->map();
  std::vector<Orders> orders(static_cast<std::size_t>(comm_->size()));
  if (crossing_.empty()) return orders;
  for (int rank = 0; rank < comm_->size(); ++rank) {
    for (std::size_t i = 0; i < ownership_->units[rank].size(); ++i)
      place_of_unit_[ownership_->units[rank][i]] = {rank, reports_[rank].of_unit[i]};
  }
  std::vector<IslandLink> links;
  links.reserve(crossing_.size());
  for (const Contact& contact : crossing_) {
    links.push_back(
        {place_of_unit_[map.unit_of_body[contact.body_a]], place_of_unit_[map.unit_of_body[contact.body_b]]});
  }
  const std::vector<double> head_start(static_cast<std::size_t>(comm_->size()), 0);
  const IslandPlan plan = plan_islands(reports_, links, head_start);
  for (const Transfer& transfer : plan.transfers) {
    std::vector<std::int32_t>& outgoing = orders[transfer.island.rank].outgoing;
    outgoing.push_back(transfer.island.island);
    outgoing.push_back(transfer.to);
    std::vector<std::int32_t>& arrivals = orders[transfer.to].arrivals;
    if (arrivals.empty() || arrivals.back() != transfer.island.rank) arrivals.push_back(transfer.island.rank);
  }
  for (std::size_t i = 0; i < crossing_.size(); ++i)
    orders[plan.solver_of_link[i]].contacts.push_back(to_wire(crossing_[i]));
  return orders;
}

}  // namespace pbmpi::mpi
