#include "effects/space_sleepers.h"

#include <algorithm>

#include "model/state_parts.h"

namespace pbmpi::effects {

void SpaceSleepers::start() {
  sleepers_.start(*state_);
  ++revision_;
}

void SpaceSleepers::put(std::span<const int> bodies, std::span<const double> rows) {
  const double* row = rows.data();
  for (const int body : bodies) row = model::take_row(row, state_->rest[body]);
  start();
}

std::vector<double> SpaceSleepers::rest_rows(std::span<const int> bodies) const {
  std::vector<double> rows;
  rows.reserve(model::row_width<model::Rest> * bodies.size());
  for (const int body : bodies) model::append_row(state_->rest[body], rows);
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
                                                 std::span<const BodyPair> touching,
                                                 const Sleepers::IsDriven& is_driven) {
  std::vector<int> awake;
  for (const int body : bodies) {
    if (!asleep(body)) awake.push_back(body);
  }
  sleepers_.count(awake, *state_);
  return sleepers_.find_resting(awake, touching, is_driven, *state_);
}

void SpaceSleepers::put_to_sleep(std::span<const Resting> resting) {
  if (resting.empty()) return;
  sleepers_.put_to_sleep(resting, *state_);
  ++revision_;
}

}  // namespace pbmpi::effects
