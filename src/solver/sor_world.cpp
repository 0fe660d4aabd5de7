#include "solver/sor_world.h"

#include <algorithm>
#include <cmath>

#include "model/effects.h"
#include "model/islands.h"
#include "solver/step_settings.h"

namespace pbmpi::solver {

SorWorld::SorWorld(int id, std::shared_ptr<const model::Model> model, const model::State& state,
                   std::int64_t step, const model::MakeNarrowPhase& make_narrow_phase)
    : id_(id),
      model_(std::move(model)),
      state_(state),
      step_(step),
      narrow_phase_(make_narrow_phase(*model_)) {
  if (!model::StepPlan(*model_).has("fast_bodies")) return;
  fast_bodies_.emplace(*model_);
  before_step_ = state_;
}

void SorWorld::enter(Pack& pack, int index) const {
  pack.load(index, state_);
  apply_settings_before(*model_, step_, index, pack);
}

void SorWorld::fire_events(Pack& pack, int index) const {
  for (const model::Event& event : events_of(*model_, step_)) {
    apply_setting(event, index, pack);
    if (event.kind == model::EventKind::launch) pack.launch(index, event);
  }
}

void SorWorld::look_ahead(const Pack& pack, int index, double dt_s, std::vector<model::Contact>& contacts) {
  if (!fast_bodies_) return;
  pack.store(index, before_step_);
  if (fast_bodies_->look(before_step_, dt_s))
    fast_bodies_->add(
        before_step_, [](int, int) { return true; }, contacts);
}

void SorWorld::count_rows(const Pack& pack, int index, std::span<const model::Contact> contacts) {
  std::vector<std::pair<int, int>> links;
  std::vector<int> rows;
  for (std::size_t j = 0; j < model_->joints.size(); ++j) {
    links.emplace_back(model_->joints[j].body_a, model_->joints[j].body_b);
    rows.push_back(pack.joint_rows(index, static_cast<int>(j)));
  }
  for (const model::Contact& contact : contacts) {
    links.emplace_back(contact.body_a, contact.body_b);
    rows.push_back(contact.mu > 0 ? 3 : 1);
  }
  const model::Islands islands = model::find_islands(model_->num_bodies(), links);
  std::vector<int> island_rows(static_cast<std::size_t>(islands.count), 0);
  observables_.rows = 0;
  for (std::size_t i = 0; i < links.size(); ++i) {
    island_rows[static_cast<std::size_t>(islands.of_body[static_cast<std::size_t>(links[i].first)])] +=
        rows[i];
    observables_.rows += rows[i];
  }
  observables_.islands = islands.count;
  observables_.max_island_rows = *std::max_element(island_rows.begin(), island_rows.end());
}

void SorWorld::observe(const Pack& pack, int index, std::span<const model::Contact> contacts) {
  pack.store(index, state_);
  count_rows(pack, index, contacts);
  observables_.contacts = static_cast<int>(contacts.size());
  observables_.max_penetration_m = 0;
  for (const model::Contact& contact : contacts) {
    observables_.max_penetration_m = std::max(observables_.max_penetration_m, contact.depth);
  }
  observables_.energy_j = model::mechanical_energy(*model_, state_);
  observables_.joint_gap_m = model::max_joint_gap(*model_, state_);
  observables_.nonfinite = model::count_nonfinite(state_);
}

}  // namespace pbmpi::solver
