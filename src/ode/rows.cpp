#include "ode/rows.h"

#include <algorithm>

#include "ode/objects/joints.h"

namespace pbmpi::ode {

RowCounter::RowCounter(const model::Model& model, const std::vector<dJointID>& joints)
    : model_(&model), joints_(joints), sets_(model.num_bodies()) {}

void RowCounter::count(const std::vector<Touch>& touches, std::span<const model::Rest> rest,
                       std::span<const std::int32_t> broken_in, stepping::Observables& observables) {
  collect(touches, rest, broken_in);
  const int num_bodies = model_->num_bodies();
  sets_.reset(num_bodies);
  for (const Link& link : links_) {
    if (link.body_a != model::no_body && link.body_b != model::no_body) sets_.unite(link.body_a, link.body_b);
  }
  set_rows_.assign(static_cast<std::size_t>(num_bodies), 0);
  observables.rows = 0;
  for (const Link& link : links_) {
    set_rows_[sets_.find(link.body_a != model::no_body ? link.body_a : link.body_b)] += link.rows;
    observables.rows += link.rows;
  }
  observables.max_island_rows = *std::max_element(set_rows_.begin(), set_rows_.end());
  observables.islands = 0;
  for (int body = 0; body < num_bodies; ++body) observables.islands += sets_.find(body) == body ? 1 : 0;
}

std::vector<stepping::IslandCost> RowCounter::islands(const std::vector<Touch>& touches) {
  std::vector<stepping::IslandCost> by_body(static_cast<std::size_t>(model_->num_bodies()));
  for (int body = 0; body < model_->num_bodies(); ++body) ++by_body[sets_.find(body)].bodies;
  for (const Touch& touch : touches) {
    by_body[sets_.find(touch.body_a != model::no_body ? touch.body_a : touch.body_b)].contacts +=
        touch.num_contacts;
  }
  std::vector<stepping::IslandCost> islands;
  for (int body = 0; body < model_->num_bodies(); ++body) {
    if (by_body[body].bodies == 0) continue;
    by_body[body].first_body = body;
    by_body[body].rows = set_rows_[body];
    islands.push_back(by_body[body]);
  }
  return islands;
}

void RowCounter::collect(const std::vector<Touch>& touches, std::span<const model::Rest> rest,
                         std::span<const std::int32_t> broken_in) {
  links_.clear();
  for (std::size_t body = 0; body < rest.size(); ++body) {
    if (rest[body].asleep()) links_.push_back({static_cast<int>(body), rest[body].island(), 0});
  }
  for (std::size_t i = 0; i < joints_.size(); ++i) {
    if (!broken_in.empty() && broken_in[i] != model::unbroken) continue;
    const model::Joint& joint = model_->joints[i];
    const bool asleep = !rest.empty() && rest[joint.body_a].asleep();
    links_.push_back({joint.body_a, joint.body_b, asleep ? 0 : count_rows(joints_[i], joint.kind)});
  }
  for (const Touch& touch : touches) {
    links_.push_back({touch.body_a, touch.body_b, touch.num_contacts * touch.rows_per_contact});
  }
}

}  // namespace pbmpi::ode
