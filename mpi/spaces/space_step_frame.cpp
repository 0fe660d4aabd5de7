/// The end of a frame: root gets all states, counts and times.
#include "mpi/spaces/space_step.h"

#include <algorithm>

#include "core/error.h"
#include "model/islands.h"
#include "model/joint_gap.h"
#include "model/mechanics.h"
#include "stepping/observable_table.h"

namespace pbmpi::mpi {

using core::Phase;
using model::Contact;

void SpaceStep::finish_frame(core::PhaseTimes& times) {
  core::LapTimer timer(times);
  if (!has_islands_) find_local_islands();
  const Measures own = measure();
  timer.lap(Phase::islands);
  if (is_root()) {
    receive_frame(own, times, timer);
  } else {
    post_frame(own, times);
    timer.lap(Phase::gather);
  }
  bodies_shipped_ = 0;
}

SpaceStep::Measures SpaceStep::measure() {
  Measures own;
  guard([&] { own.seen = stepper_->count(active_units_, contacts_); });
  const model::Model& model = stepper_->model();
  const model::State& state = stepper_->state();
  for (const int body : ownership_->bodies[comm_->rank()])
    own.energy_j.push_back(model::body_energy(model, state, body));
  for (std::size_t i = 0; i < model.joints.size(); ++i) {
    const model::Joint& joint = model.joints[i];
    if (state.is_broken(i)) continue;
    if (ownership_->owner[stepper_->map().space_of_body(joint.body_a)] == comm_->rank())
      own.seen.joint_gap_m = std::max(own.seen.joint_gap_m, model::joint_gap(model, state, joint));
  }
  return own;
}

void SpaceStep::post_frame(const Measures& own, const core::PhaseTimes& times) {
  if (!crosses_) mail_->finish();  // root has the message of the frame before
  MessageWriter message;
  message.put(state_rows(stepper_->state(), ownership_->bodies[comm_->rank()]));
  if (sleepers_) message.put(sleepers_->rest_rows(ownership_->bodies[comm_->rank()]));
  if (joints_break_) message.put(stepper_->broken_rows(own_units()));
  message.put(own_boxes());
  message.put_value(own.seen);
  message.put(own.energy_j);
  message.put_value(times);
  message.put_value(bodies_shipped_);
  message.put(islands_.of_unit);
  message.put(unit_weight_);
  if (field_ != nullptr) message.put(unit_near_);
  mail_->post(message.take(), Communicator::root, frame_tag);
}

void SpaceStep::receive_frame(const Measures& own, const core::PhaseTimes& times, core::LapTimer& timer) {
  findings_ = {};
  findings_.energy_j.resize(stepper_->model().bodies.size());
  note_measures(Communicator::root, own.seen, own.energy_j);
  findings_.weight.resize(static_cast<std::size_t>(stepper_->map().num_units()));
  if (field_ != nullptr) findings_.near.resize(findings_.weight.size());
  findings_.times.resize(static_cast<std::size_t>(comm_->size()));
  findings_.times.front() = times;
  findings_.bodies_shipped = bodies_shipped_;
  std::vector<std::vector<std::int32_t>> islands(static_cast<std::size_t>(comm_->size()));
  islands.front() = islands_.of_unit;
  note_weights(Communicator::root, unit_weight_);
  if (field_ != nullptr) note_near(Communicator::root, unit_near_);
  for (int rank = 1; rank < comm_->size(); ++rank) {
    MessageReader message(mail_->take(rank, frame_tag));
    timer.lap(Phase::wait);
    take_frame(rank, message);
    const auto of_unit = message.get<std::int32_t>();
    islands[rank].assign(of_unit.begin(), of_unit.end());
    note_weights(rank, message.get<std::int32_t>());
    if (field_ != nullptr) note_near(rank, message.get<char>());
    timer.lap(Phase::gather);
  }
  has_poses_ = true;
  if (!crosses_ && ownership_->is_divided()) guard([&] { require_apart(); });
  join_findings(islands);
  timer.lap(Phase::islands);
}

/// The scene's word is taken for each step, and checked once a frame.
void SpaceStep::require_apart() {
  for (const int space : ownership_->spaces[comm_->rank()]) boxes_[space] = stepper_->space_box(space);
  stepper_->collide_across(ownership_->owner, boxes_, crossing_);
  if (crossing_.empty()) return;
  const model::Model& model = stepper_->model();
  const auto name = [&](int body) {
    return "'" + model.bodies[body].name + "' of space '" +
           model.spaces[stepper_->map().space_of_body(body)] + "'";
  };
  throw core::RunError(name(crossing_.front().body_a) + " touches " + name(crossing_.front().body_b) +
                       ", though the scene says inter_space = \"none\"; drop that line");
}

void SpaceStep::take_frame(int rank, MessageReader& message) {
  stepper_->put_states(ownership_->bodies[rank], message.get<double>());
  if (sleepers_) sleepers_->put(ownership_->bodies[rank], message.get<double>());
  if (joints_break_) stepper_->put_broken(ownership_->units[rank], message.get<std::int32_t>());
  const auto boxes = message.get<geometry::Box>();
  for (std::size_t i = 0; i < boxes.size(); ++i) boxes_[ownership_->spaces[rank][i]] = boxes[i];
  const auto seen = message.get_value<stepping::Observables>();
  note_measures(rank, seen, message.get<double>());
  findings_.times[rank] = message.get_value<core::PhaseTimes>();
  findings_.bodies_shipped += message.get_value<std::int64_t>();
}

void SpaceStep::note_measures(int rank, const stepping::Observables& seen, std::span<const double> energy_j) {
  stepping::join(findings_.seen, seen);
  for (std::size_t i = 0; i < energy_j.size(); ++i)
    findings_.energy_j[ownership_->bodies[rank][i]] = energy_j[i];
}

void SpaceStep::note_weights(int rank, std::span<const std::int32_t> weights) {
  for (std::size_t i = 0; i < weights.size(); ++i) findings_.weight[ownership_->units[rank][i]] = weights[i];
}

/// Islands of the world: those of the ranks, joined by the contacts across spaces.
void SpaceStep::join_findings(std::span<const std::vector<std::int32_t>> islands) {
  const model::SpaceMap& map = stepper_->map();
  model::DisjointSets sets(map.num_units());
  for (int rank = 0; rank < comm_->size(); ++rank) {
    std::vector<int> first(islands[rank].size(), -1);
    for (std::size_t i = 0; i < islands[rank].size(); ++i) {
      int& lowest = first[islands[rank][i]];
      if (lowest < 0) lowest = ownership_->units[rank][i];
      sets.unite(lowest, ownership_->units[rank][i]);
    }
  }
  if (crosses_) {
    for (const Contact& contact : crossing_) {
      const int unit = map.unit_of_body[contact.body_a];
      sets.unite(unit, map.unit_of_body[contact.body_b]);
      findings_.weight[unit] += model::contact_rows(contact.mu);
    }
  }
  for (int unit = 0; unit < map.num_units(); ++unit) findings_.island.push_back(sets.find(unit));
  if (field_ != nullptr) join_near();
}

}  // namespace pbmpi::mpi
