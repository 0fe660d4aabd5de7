#include "mpi/spaces/step/crossing_search.h"

#include <algorithm>
#include <numeric>

#include "core/error.h"
#include "effects/motors.h"
#include "model/state_parts.h"
#include "mpi/comm/message.h"
#include "mpi/comm/processor_time.h"
#include "mpi/spaces/step/wire.h"

namespace pbmpi::mpi {

using core::Phase;

namespace {

/// Where a box will be after two steps more in which its sides move outwards as they did in the last one.
geometry::Box grown_on(const geometry::Box& now, const geometry::Box& before) {
  geometry::Box next = now;
  for (std::size_t k = 0; k < 3; ++k) {
    next.min[k] -= 2 * std::max(0.0, before.min[k] - now.min[k]);
    next.max[k] += 2 * std::max(0.0, now.max[k] - before.max[k]);
  }
  return next;
}

}  // namespace

void CrossingSearch::own() {
  const std::size_t num_spaces = shared_->ownership->owner.size();
  sends_all_ = shared_->sleepers != nullptr || shared_->stepper->has_velocity_rules();
  watched_.assign(num_spaces, sends_all_ ? 1 : 0);
  if (!shared_->is_root()) return;
  note_whole_state();
  std::vector<int> all(num_spaces);
  std::iota(all.begin(), all.end(), 0);
  shared_->guard([&] { boxes_ = shared_->stepper->space_boxes(all); });
  boxes_.resize(num_spaces);
  last_boxes_ = boxes_;
  schedule_ = RootSchedule(shared_->comm->size());
}

void CrossingSearch::note_whole_state() {
  has_borders_ = true;
  is_current_.assign(shared_->ownership->owner.size(), 1);
}

void CrossingSearch::search_early(std::int64_t step, core::LapTimer& timer) {
  if (!shared_->crosses || !shared_->is_root() || shared_->sleepers != nullptr) return;
  schedule_.note_own(pace_);
  if (has_borders_) schedule_.start_all(core::now_s());
  bool arrived = borders_have_arrived();
  if (!arrived) {
    const Waiting waiting;
    while (!arrived && schedule_.should_wait(unseen_s_)) arrived = borders_have_arrived();
  }
  timer.lap(Phase::wait);
  if (arrived) send_verdict(step, timer);
}

bool CrossingSearch::borders_have_arrived() {
  if (has_borders_) return true;
  for (int rank = 1; rank < shared_->comm->size(); ++rank) {
    if (shared_->mail->has(rank, border_tag)) continue;
    unseen_s_ = core::now_s();
    return false;
  }
  return true;
}

void CrossingSearch::search(std::int64_t step, core::LapTimer& timer) {
  if (!has_borders_) receive_borders(step, timer);
  began_s_ = core::now_s();
  shared_->guard([&] { launch_others(step); });
  timer.lap(Phase::cross_space);
  fetch_missing(timer);
  shared_->guard([&] { find_contacts(); });
  timer.lap(Phase::cross_space);
}

void CrossingSearch::launch_others(std::int64_t step) {
  shared_->stepper->launch_others(step);
  std::vector<int> changed = launched_spaces(step);
  changed.insert(changed.end(), shared_->own_spaces().begin(), shared_->own_spaces().end());
  if (shared_->stepper->has_velocity_rules()) {
    changed.resize(boxes_.size());
    std::iota(changed.begin(), changed.end(), 0);
  }
  std::ranges::sort(changed);
  const std::vector<geometry::Box> boxes = shared_->stepper->space_boxes(changed);
  for (std::size_t i = 0; i < boxes.size(); ++i) boxes_[changed[i]] = boxes[i];
}

void CrossingSearch::find_contacts() {
  shared_->stepper->collide_across(shared_->ownership->owner, boxes_, contacts_);
}

void CrossingSearch::fetch_missing(core::LapTimer& timer) {
  std::vector<char> is_missing(boxes_.size(), 0);
  shared_->guard([&] {
    for (const int space : shared_->stepper->near_spaces(shared_->ownership->owner, boxes_))
      is_missing[space] = is_current_[space] == 0 ? 1 : 0;
  });
  std::vector<int> asked;
  for (int rank = 1; rank < shared_->comm->size(); ++rank) {
    const std::vector<std::int32_t> spaces = spaces_of(rank, is_missing);
    if (spaces.empty()) continue;
    post(Verdict::more, rank, spaces);
    asked.push_back(rank);
  }
  timer.lap(Phase::cross_space);
  for (const int rank : asked) {
    MessageReader message(shared_->mail->take(rank, more_tag));
    timer.lap(Phase::wait);
    const std::vector<std::int32_t> spaces = spaces_of(rank, is_missing);
    shared_->stepper->put_states(bodies_of(spaces), message.get<double>());
    for (const std::int32_t space : spaces) is_current_[space] = 1;
    timer.lap(Phase::gather);
  }
}

bool CrossingSearch::finds_any(std::int64_t step, core::LapTimer& timer) {
  if (shared_->is_root()) {
    if (!has_verdict_) send_verdict(step, timer);
    return !contacts_.empty();
  }
  for (;;) {
    MessageReader message(shared_->mail->take(Communicator::root, verdict_tag));
    timer.lap(Phase::wait);
    const auto verdict = message.get_value<Verdict>();
    const auto spaces = message.get<std::int32_t>();
    if (verdict == Verdict::more) {
      MessageWriter answer;
      answer.put(model::body_rows(shared_->stepper->state(), bodies_of(spaces)));
      shared_->mail->post(answer.take(), Communicator::root, more_tag);
      timer.lap(Phase::gather);
      continue;
    }
    verdict_s_ = core::now_s();
    watched_.assign(watched_.size(), 0);
    for (const std::int32_t space : spaces) watched_[space] = 1;
    shared_->mail->finish();  // returns at once: root has received all messages of the step before
    return verdict == Verdict::touching;
  }
}

void CrossingSearch::send_verdict(std::int64_t step, core::LapTimer& timer) {
  if (shared_->sleepers == nullptr) search(step, timer);  // with sleepers the search is done
  has_borders_ = false;
  has_verdict_ = true;
  shared_->guard([&] { watch_next(); });
  shared_->mail->finish();  // returns at once: the ranks have received all messages of the step before
  verdict_s_ = core::now_s();
  schedule_.note_verdict(verdict_s_, verdict_s_ - began_s_);
  for (int rank = 1; rank < shared_->comm->size(); ++rank)
    post(contacts_.empty() ? Verdict::apart : Verdict::touching, rank, spaces_of(rank, watched_));
  timer.lap(Phase::cross_space);
}

void CrossingSearch::post(Verdict verdict, int rank, std::span<const std::int32_t> spaces) const {
  MessageWriter message;
  message.put_value(verdict);
  message.put(spaces);
  shared_->mail->post(message.take(), rank, verdict_tag);
}

void CrossingSearch::watch_next() {
  if (!sends_all_) {
    std::vector<geometry::Box> grown;
    for (std::size_t space = 0; space < boxes_.size(); ++space)
      grown.push_back(grown_on(boxes_[space], last_boxes_[space]));
    watched_.assign(boxes_.size(), 0);
    for (const int space : shared_->stepper->near_spaces(shared_->ownership->owner, grown))
      watched_[space] = 1;
  }
  last_boxes_ = boxes_;
}

std::vector<std::int32_t> CrossingSearch::sent_spaces(int rank, std::int64_t step) const {
  std::vector<char> sent = watched_;
  for (const int space : launched_spaces(step)) sent[space] = 1;
  return spaces_of(rank, sent);
}

std::vector<int> CrossingSearch::launched_spaces(std::int64_t step) const {
  std::vector<int> spaces;
  for (const model::Event& event : effects::events_of(shared_->stepper->model(), step)) {
    if (event.kind == model::EventKind::launch)
      spaces.push_back(shared_->stepper->map().space_of_body(event.body));
  }
  return spaces;
}

std::vector<std::int32_t> CrossingSearch::spaces_of(int rank, std::span<const char> flags) const {
  std::vector<std::int32_t> spaces;
  for (const int space : shared_->ownership->spaces[rank]) {
    if (flags[space] != 0) spaces.push_back(space);
  }
  return spaces;
}

std::vector<int> CrossingSearch::bodies_of(std::span<const std::int32_t> spaces) const {
  const model::SpaceMap& map = shared_->stepper->map();
  std::vector<int> units;
  for (const std::int32_t space : spaces)
    units.insert(units.end(), map.units_of_space[space].begin(), map.units_of_space[space].end());
  return mpi::bodies_of(map, units);
}

void CrossingSearch::note_pace(double began_s, double collided_s) {
  pace_ = {collided_s - began_s, core::now_s() - std::max(verdict_s_, collided_s)};
}

std::vector<geometry::Box> CrossingSearch::own_boxes() const {
  std::vector<geometry::Box> boxes;
  shared_->guard([&] { boxes = shared_->stepper->space_boxes(shared_->own_spaces()); });
  boxes.resize(shared_->own_spaces().size());
  return boxes;
}

void CrossingSearch::put_boxes(int rank, std::span<const geometry::Box> boxes) {
  for (std::size_t i = 0; i < boxes.size(); ++i) boxes_[shared_->ownership->spaces[rank][i]] = boxes[i];
}

void CrossingSearch::post_border(std::int64_t next_step) {
  MessageWriter message;
  message.put(own_boxes());
  message.put_value(pace_);
  const std::vector<int> bodies = bodies_of(sent_spaces(shared_->comm->rank(), next_step));
  message.put(model::body_rows(shared_->stepper->state(), bodies));
  shared_->mail->post(message.take(), Communicator::root, border_tag);
}

void CrossingSearch::receive_borders(std::int64_t step, core::LapTimer& timer) {
  is_current_.assign(is_current_.size(), 0);
  for (const int space : shared_->own_spaces()) is_current_[space] = 1;
  for (int rank = 1; rank < shared_->comm->size(); ++rank) {
    MessageReader message(shared_->mail->take(rank, border_tag));
    timer.lap(Phase::wait);
    put_boxes(rank, message.get<geometry::Box>());
    schedule_.note_arrival(rank, unseen_s_, core::now_s(), message.get_value<StepPace>());
    const std::vector<std::int32_t> spaces = sent_spaces(rank, step);
    shared_->stepper->put_states(bodies_of(spaces), message.get<double>());
    for (const std::int32_t space : spaces) is_current_[space] = 1;
    timer.lap(Phase::gather);
  }
  has_borders_ = true;
}

void CrossingSearch::skip_step(std::int64_t step, core::LapTimer& timer) {
  contacts_.clear();
  if (shared_->crosses && shared_->is_root() && !has_borders_) receive_borders(step, timer);
}

void CrossingSearch::require_apart() {
  const std::vector<geometry::Box> boxes = own_boxes();
  put_boxes(Communicator::root, boxes);
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
