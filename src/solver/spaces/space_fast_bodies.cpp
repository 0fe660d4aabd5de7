#include "solver/spaces/space_fast_bodies.h"

namespace pbmpi::solver {

SpaceFastBodies::SpaceFastBodies(const model::Model& model, const model::SpaceMap& map, double dt_s,
                                 double most_approach_m)
    : model_(&model),
      map_(&map),
      dt_s_(dt_s),
      most_approach_m_(most_approach_m),
      all_(model, {}, most_approach_m),
      owner_of_body_(model.bodies.size()) {}

std::vector<int> SpaceFastBodies::find_own(const model::State& state) {
  own_->look(state, dt_s_);
  return own_->moving_bodies();
}

int SpaceFastBodies::add_own(const model::State& state, std::vector<model::Contact>& contacts) {
  if (own_->look(state, dt_s_))
    own_->add(
        state, [](int, int) { return true; }, contacts);
  return static_cast<int>(own_->bodies().size());
}

void SpaceFastBodies::add_across(const model::State& state, std::span<const int> owner,
                                 std::vector<model::Contact>& contacts) {
  if (!all_.look(state, dt_s_)) return;
  for (int body = 0; body < model_->num_bodies(); ++body)
    owner_of_body_[body] = owner[map_->space_of_body(body)];
  all_.add_across(state, owner_of_body_, contacts);
}

}  // namespace pbmpi::solver
