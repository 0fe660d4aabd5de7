#include "solver/spaces/space_fast_bodies.h"

namespace pbmpi::solver {

SpaceFastBodies::SpaceFastBodies(const model::Model& model, const model::SpaceMap& map, double dt_s,
                                 double most_approach_m)
    : map_(&map),
      dt_s_(dt_s),
      own_(model, most_approach_m),
      others_(model, most_approach_m),
      owner_of_body_(model.bodies.size(), 0) {}

int SpaceFastBodies::add_own(const model::State& state, std::vector<model::Contact>& contacts) {
  if (own_.look(state, dt_s_))
    own_.add(
        state, [](int, int) { return true; }, contacts);
  return static_cast<int>(own_.bodies().size());
}

void SpaceFastBodies::widen(const model::State& state, std::span<const int> bodies,
                            std::span<geometry::Box> boxes) {
  others_.choose(bodies);
  others_.look(state, dt_s_);
  for (const effects::FastBodies::Reach& reach : others_.reaches(state))
    boxes[map_->space_of_body(reach.body)].include(reach.box);
}

void SpaceFastBodies::add_across(const model::State& state, std::span<const int> bodies,
                                 std::span<const int> owner, std::vector<model::Contact>& contacts) {
  others_.choose(bodies);
  if (!others_.look(state, dt_s_)) return;
  for (const int body : bodies) owner_of_body_[body] = owner[map_->space_of_body(body)];
  others_.add_across(state, owner_of_body_, contacts);
}

}  // namespace pbmpi::solver
