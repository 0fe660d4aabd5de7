/// What the ranks agree on in a step of a world in which islands sleep. Every rank knows who sleeps, so that
/// a step in which all do costs no message.
#include "mpi/spaces/space_step.h"

#include <algorithm>

namespace pbmpi::mpi {

using core::Phase;
using effects::BodyPair;
using effects::Resting;

/// Whether a rank has failed or not it knows who sleeps: what the ranks exchange follows from it.
bool SpaceStep::sleeps_on(std::int64_t step) {
  if (sleepers_ == nullptr) return false;
  sleepers_->wake_called(step);
  return sleepers_->all_asleep();
}

void SpaceStep::sleep_on(bool last, core::PhaseTimes& times) {
  core::LapTimer timer(times);
  contacts_.clear();
  crossing_.clear();
  active_units_ = own_units();
  if (crosses_ && is_root() && !has_poses_) {  // sent before the last island fell asleep
    receive_poses(timer);
    has_poses_ = true;
  }
  if (!last) return;
  find_local_islands();
  finish_frame(times);
}

/// Until no awake body touches a sleeping one, here or across spaces.
void SpaceStep::wake_touched(std::int64_t step, core::LapTimer& timer) {
  for (bool first = true;; first = false) {
    if (!first) guard([&] { stepper_->collide(contacts_); });
    timer.lap(Phase::collide);
    std::vector<int> islands;
    if (crosses_ && is_root()) look_across(step, timer);
    guard([&] {
      islands = sleepers_->islands_touched(contacts_);
      if (!crosses_ || !is_root()) return;
      const std::vector<int> across = sleepers_->islands_touched(crossing_);
      islands.insert(islands.end(), across.begin(), across.end());
    });
    if (crosses_) {
      islands = comm_->allgatherv(std::span<const int>(islands));
      std::sort(islands.begin(), islands.end());
      timer.lap(Phase::wait);
    }
    if (!sleepers_->wake(islands)) break;
  }
  touching_ = effects::touching_bodies(contacts_);
}

/// Islands of which all parts rest fall asleep, on every rank's word.
void SpaceStep::settle(core::LapTimer& timer) {
  std::vector<Resting> resting;
  guard([&] { resting = sleepers_->find_resting(ownership_->bodies[comm_->rank()], touching_); });
  timer.lap(Phase::islands);
  if (crosses_) {
    resting = comm_->allgatherv(std::span<const Resting>(resting));
    if (!resting.empty()) resting = join_resting(resting);
    timer.lap(Phase::wait);
  }
  sleepers_->put_to_sleep(resting);
}

std::vector<Resting> SpaceStep::join_resting(std::span<const Resting> resting) {
  std::vector<int> across;  // root's contacts: two bodies each
  if (is_root()) {
    for (const model::Contact& contact : crossing_) {
      across.push_back(contact.body_a);
      across.push_back(contact.body_b);
    }
  }
  across = comm_->allgatherv(std::span<const int>(across));
  std::vector<BodyPair> touching;
  for (std::size_t i = 0; i < across.size(); i += 2) touching.emplace_back(across[i], across[i + 1]);
  return effects::Sleepers::join(stepper_->model().num_bodies(), resting, touching);
}

}  // namespace pbmpi::mpi
