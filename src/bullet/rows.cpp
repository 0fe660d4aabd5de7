#include "bullet/rows.h"

#include <algorithm>

namespace pbmpi::bullet {

RowCounter::RowCounter(const model::Model& model, AxisJoints& joints)
    : model_(&model), joints_(&joints), sets_(model.num_bodies()) {}

void RowCounter::count(const std::vector<Touch>& touches, const model::State& state,
                       stepping::Observables& observables) {
  collect(touches, state);
  const int num_bodies = model_->num_bodies();
  sets_.reset(num_bodies);
  for (const Link& link : links_) {
    if (link.body_a != model::no_body && link.body_b != model::no_body) sets_.unite(link.body_a, link.body_b);
  }
  set_rows_.assign(static_cast<std::size_t>(num_bodies), 0);
  observables.rows = 0;
  for (const Link& link : links_) {
    const int body = sets_.find(link.body_a != model::no_body ? link.body_a : link.body_b);
    set_rows_[static_cast<std::size_t>(body)] += link.rows;
    observables.rows += link.rows;
  }
  observables.max_island_rows = *std::max_element(set_rows_.begin(), set_rows_.end());
  observables.islands = 0;
  for (int body = 0; body < num_bodies; ++body) observables.islands += sets_.find(body) == body ? 1 : 0;
}

void RowCounter::collect(const std::vector<Touch>& touches, const model::State& state) {
  links_.clear();
  const auto asleep = [&](int body) {
    return !state.rest.empty() && state.rest[static_cast<std::size_t>(body)].asleep();
  };
  for (int body = 0; body < model_->num_bodies(); ++body) {
    if (asleep(body)) links_.push_back({body, state.rest[static_cast<std::size_t>(body)].island(), 0});
  }
  for (int i = 0; i < model_->num_joints(); ++i) {
    if (state.is_broken(static_cast<std::size_t>(i))) continue;
    const model::Joint& joint = model_->joints[static_cast<std::size_t>(i)];
    links_.push_back({joint.body_a, joint.body_b, asleep(joint.body_a) ? 0 : joints_->count_rows(i)});
  }
  for (const Touch& touch : touches)
    links_.push_back({touch.body_a, touch.body_b, touch.num_contacts * touch.rows_per_contact});
}

}  // namespace pbmpi::bullet
