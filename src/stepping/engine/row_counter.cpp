#include "stepping/engine/row_counter.h"

#include <algorithm>

namespace pbmpi::stepping {

void RowCounter::count(const std::vector<Touch>& touches, const model::State& state,
                       const RowsOfJoint& rows_of_joint, Observables& observables) {
  collect(touches, state, rows_of_joint);
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

std::vector<IslandCost> RowCounter::islands(const std::vector<Touch>& touches) {
  std::vector<IslandCost> by_body(static_cast<std::size_t>(model_->num_bodies()));
  const auto island_with = [&](int body) -> IslandCost& {
    return by_body[static_cast<std::size_t>(sets_.find(body))];
  };
  for (int body = 0; body < model_->num_bodies(); ++body) ++island_with(body).bodies;
  for (const Touch& touch : touches)
    island_with(touch.body_a != model::no_body ? touch.body_a : touch.body_b).contacts += touch.num_contacts;
  std::vector<IslandCost> islands;
  for (std::size_t body = 0; body < by_body.size(); ++body) {
    if (by_body[body].bodies == 0) continue;
    by_body[body].first_body = static_cast<int>(body);
    by_body[body].rows = set_rows_[body];
    islands.push_back(by_body[body]);
  }
  return islands;
}

void RowCounter::collect(const std::vector<Touch>& touches, const model::State& state,
                         const RowsOfJoint& rows_of_joint) {
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
    links_.push_back({joint.body_a, joint.body_b, asleep(joint.body_a) ? 0 : rows_of_joint(i)});
  }
  for (const Touch& touch : touches)
    links_.push_back({touch.body_a, touch.body_b, touch.num_contacts * touch.rows_per_contact});
}

}  // namespace pbmpi::stepping
