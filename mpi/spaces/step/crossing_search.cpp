#include "mpi/spaces/step/crossing_search.h"

#include <algorithm>

#include "core/error.h"
#include "model/state_parts.h"
#include "mpi/comm/message.h"

namespace pbmpi::mpi {

using core::Phase;

void CrossingSearch::own() {
  if (!shared_->is_root()) return;
  has_poses_ = true;
  boxes_.resize(shared_->ownership->owner.size());
  for (std::size_t space = 0; space < boxes_.size(); ++space)
    boxes_[space] = shared_->stepper->space_box(static_cast<int>(space));
  schedule_ = RootSchedule(shared_->comm->size());
}

void CrossingSearch::search_early(std::int64_t step, core::LapTimer& timer) {
  if (!shared_->crosses || !shared_->is_root() || shared_->sleepers != nullptr) return;
  schedule_.note_own(pace_);
  if (has_poses_) schedule_.start_all(core::now_s());
  bool arrived = poses_have_arrived();
  while (!arrived && schedule_.should_wait(unseen_s_)) arrived = poses_have_arrived();
  timer.lap(Phase::wait);
  if (arrived) send_verdict(step, timer);
}

bool CrossingSearch::poses_have_arrived() {
  if (has_poses_) return true;
  for (int rank = 1; rank < shared_->comm->size(); ++rank) {
    if (shared_->mail->has(rank, poses_tag)) continue;
    unseen_s_ = core::now_s();
    return false;
  }
  return true;
}

void CrossingSearch::search(std::int64_t step, core::LapTimer& timer) {
  if (!has_poses_) receive_poses(timer);
  began_s_ = core::now_s();
  shared_->guard([&] {
    shared_->stepper->launch_others(step, boxes_);
    find_contacts();
  });
  timer.lap(Phase::cross_space);
}

void CrossingSearch::find_contacts() {
  for (const int space : shared_->own_spaces()) boxes_[space] = shared_->stepper->space_box(space);
  shared_->stepper->collide_across(shared_->ownership->owner, boxes_, contacts_);
}

bool CrossingSearch::finds_any(std::int64_t step, core::LapTimer& timer) {
  if (shared_->is_root()) {
    if (!has_verdict_) send_verdict(step, timer);
    return !contacts_.empty();
  }
  MessageReader verdict(shared_->mail->take(Communicator::root, verdict_tag));
  timer.lap(Phase::wait);
  verdict_s_ = core::now_s();
  shared_->mail->finish();  // returns at once: root has received all messages of the step before
  return verdict.get_value<std::int32_t>() != 0;
}

void CrossingSearch::send_verdict(std::int64_t step, core::LapTimer& timer) {
  if (shared_->sleepers == nullptr) search(step, timer);  // with sleepers the search is done
  has_poses_ = false;
  has_verdict_ = true;
  shared_->mail->finish();  // returns at once: the ranks have received all messages of the step before
  verdict_s_ = core::now_s();
  schedule_.note_verdict(verdict_s_, verdict_s_ - began_s_);
  for (int rank = 1; rank < shared_->comm->size(); ++rank) {
    MessageWriter message;
    message.put_value(static_cast<std::int32_t>(contacts_.empty() ? 0 : 1));
    shared_->mail->post(message.take(), rank, verdict_tag);
  }
  timer.lap(Phase::cross_space);
}

void CrossingSearch::note_pace(double began_s, double collided_s) {
  pace_ = {collided_s - began_s, core::now_s() - std::max(verdict_s_, collided_s)};
}

std::vector<geometry::Box> CrossingSearch::own_boxes() const {
  std::vector<geometry::Box> boxes;
  for (const int space : shared_->own_spaces()) boxes.push_back(shared_->stepper->space_box(space));
  return boxes;
}

void CrossingSearch::put_boxes(int rank, std::span<const geometry::Box> boxes) {
  for (std::size_t i = 0; i < boxes.size(); ++i) boxes_[shared_->ownership->spaces[rank][i]] = boxes[i];
}

void CrossingSearch::post_poses() {
  const model::State& state = shared_->stepper->state();
  MessageWriter message;
  message.put(model::body_rows(state, shared_->own_bodies(), model::pose_columns));
  message.put(own_boxes());
  message.put_value(pace_);
  if (shared_->has_fast_bodies) {
    std::vector<int> fast;
    shared_->guard([&] { fast = shared_->stepper->fast_bodies(); });
    message.put(fast);
    message.put(model::body_rows(state, fast));
  }
  shared_->mail->post(message.take(), Communicator::root, poses_tag);
}

void CrossingSearch::receive_poses(core::LapTimer& timer) {
  for (int rank = 1; rank < shared_->comm->size(); ++rank) {
    MessageReader message(shared_->mail->take(rank, poses_tag));
    timer.lap(Phase::wait);
    shared_->stepper->put_poses(shared_->ownership->bodies[rank], message.get<double>());
    put_boxes(rank, message.get<geometry::Box>());
    schedule_.note_arrival(rank, unseen_s_, core::now_s(), message.get_value<StepPace>());
    if (shared_->has_fast_bodies) {
      const std::span<const int> fast = message.get<int>();
      shared_->stepper->put_states(fast, message.get<double>());
    }
    timer.lap(Phase::gather);
  }
  has_poses_ = true;
}

void CrossingSearch::skip_step(core::LapTimer& timer) {
  contacts_.clear();
  if (shared_->crosses && shared_->is_root() && !has_poses_) receive_poses(timer);
}

void CrossingSearch::require_apart() {
  find_contacts();
  if (contacts_.empty()) return;
  const model::Model& model = shared_->stepper->model();
  const auto name = [&](int body) {
    return "'" + model.bodies[body].name + "' of space '" +
           model.spaces[shared_->stepper->map().space_of_body(body)] + "'";
  };
  throw core::RunError(name(contacts_.front().body_a) + " touches " + name(contacts_.front().body_b) +
                       ", though the scene says inter_space = \"none\"; drop that line");
}

}  // namespace pbmpi::mpi
