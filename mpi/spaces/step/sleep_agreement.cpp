#include "mpi/spaces/step/sleep_agreement.h"

#include <algorithm>

#include "effects/motors.h"

namespace pbmpi::mpi {

using core::Phase;
using effects::BodyPair;
using effects::Resting;

bool SleepAgreement::sleeps_through(std::int64_t step) {
  if (shared_->sleepers == nullptr) return false;
  shared_->sleepers->wake_called(step);
  return shared_->sleepers->all_asleep();
}

void SleepAgreement::wake_touched(std::int64_t step, std::vector<model::Contact>& contacts,
                                  core::LapTimer& timer) {
  if (shared_->sleepers == nullptr) return;
  const bool searches = shared_->crosses && shared_->is_root();
  for (bool first = true;; first = false) {
    if (!first) shared_->guard([&] { shared_->stepper->collide(contacts); });
    timer.lap(Phase::collide);
    std::vector<int> islands;
    if (searches) crossing_->search(step, timer);
    shared_->guard([&] {
      islands = shared_->sleepers->islands_touched(contacts);
      if (!searches) return;
      const std::vector<int> across = shared_->sleepers->islands_touched(crossing_->contacts());
      islands.insert(islands.end(), across.begin(), across.end());
    });
    if (shared_->crosses) {
      islands = shared_->comm->allgatherv(std::span<const int>(islands));
      std::sort(islands.begin(), islands.end());
      timer.lap(Phase::wait);
    }
    if (!shared_->sleepers->wake(islands)) break;
  }
  touching_ = effects::touching_bodies(contacts);
}

void SleepAgreement::put_resting_to_sleep(std::int64_t step, core::LapTimer& timer) {
  if (shared_->sleepers == nullptr) return;
  const auto is_driven = [&](int joint) {
    return effects::is_driven_before(shared_->stepper->model(), step + 1, joint);
  };
  std::vector<Resting> resting;
  shared_->guard(
      [&] { resting = shared_->sleepers->find_resting(shared_->own_bodies(), touching_, is_driven); });
  timer.lap(Phase::islands);
  if (shared_->crosses) {
    resting = shared_->comm->allgatherv(std::span<const Resting>(resting));
    timer.lap(Phase::wait);
  }
  if (!resting.empty()) resting = join(resting);
  shared_->sleepers->put_to_sleep(resting);
}

/// Joins the ranks' parts of islands by the contacts across spaces, which only root knows.
std::vector<Resting> SleepAgreement::join(std::span<const Resting> resting) {
  std::vector<int> across;  // two bodies per contact
  if (shared_->crosses && shared_->is_root()) {
    for (const model::Contact& contact : crossing_->contacts()) {
      across.push_back(contact.body_a);
      across.push_back(contact.body_b);
    }
  }
  if (shared_->crosses) across = shared_->comm->allgatherv(std::span<const int>(across));
  std::vector<BodyPair> touching;
  for (std::size_t i = 0; i < across.size(); i += 2) touching.emplace_back(across[i], across[i + 1]);
  return effects::Sleepers::join(shared_->stepper->model().num_bodies(), resting, touching);
}

}  // namespace pbmpi::mpi
