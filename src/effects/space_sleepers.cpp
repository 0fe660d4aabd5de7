#include "effects/space_sleepers.h"

#include <algorithm>
#include <cstring>

namespace pbmpi::effects {

void SpaceSleepers::start() {
  sleepers_.start(*state_);
  ++revision_;
}

void SpaceSleepers::put(std::span<const int> bodies, std::span<const double> rows) {
  const double* row = rows.data();
  for (const int body : bodies) {
    model::Rest& rest = state_->rest[body];
    std::memcpy(rest.position.data(), row, 3 * sizeof(double));
    rest.orientation = {row[3], row[4], row[5], row[6]};
    rest.idle_steps = static_cast<std::int32_t>(row[7]);
    row += model::numbers_of_rest;
  }
  start();
}

std::vector<double> SpaceSleepers::rest_rows(std::span<const int> bodies) const {
  std::vector<double> rows;
  rows.reserve(model::numbers_of_rest * bodies.size());
  for (const int body : bodies) {
    const model::Rest& rest = state_->rest[body];
    const core::Quat& q = rest.orientation;
    for (const double number : {rest.position.x(), rest.position.y(), rest.position.z(), q.w, q.x, q.y, q.z,
                                static_cast<double>(rest.idle_steps)})
      rows.push_back(number);
  }
  return rows;
}

std::vector<int> SpaceSleepers::islands_touched(std::span<const model::Contact> contacts) const {
  return Sleepers::islands_touched(touching_bodies(contacts), *state_);
}

bool SpaceSleepers::wake(std::span<const int> islands) {
  if (!sleepers_.wake(islands, *state_)) return false;
  ++revision_;
  return true;
}

bool SpaceSleepers::wake_islands_of(std::span<const int> bodies) {
  std::vector<int> islands;
  for (const int body : bodies) {
    if (body != model::no_body && asleep(body)) islands.push_back(island(body));
  }
  std::sort(islands.begin(), islands.end());
  return wake(islands);
}

std::vector<Resting> SpaceSleepers::find_resting(std::span<const int> bodies,
                                                 std::span<const BodyPair> touching) {
  std::vector<int> awake;
  for (const int body : bodies) {
    if (!asleep(body)) awake.push_back(body);
  }
  sleepers_.count(awake, *state_);
  return sleepers_.find_resting(awake, touching, *state_);
}

void SpaceSleepers::put_to_sleep(std::span<const Resting> resting) {
  if (resting.empty()) return;
  sleepers_.put_to_sleep(resting, *state_);
  ++revision_;
}

}  // namespace pbmpi::effects
