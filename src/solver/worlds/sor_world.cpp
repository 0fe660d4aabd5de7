#include "solver/worlds/sor_world.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

#include "effects/effects.h"
#include "model/islands.h"
#include "solver/pack/step_settings.h"
#include "stepping/observable_table.h"

namespace pbmpi::solver {

SorWorld::SorWorld(int id, std::shared_ptr<const model::Model> model, const model::State& state,
                   std::int64_t step, const stepping::StepperSettings& settings,
                   const model::MakeNarrowPhase& make_narrow_phase)
    : id_(id),
      model_(std::move(model)),
      passes_(passes_of(*model_)),
      narrow_phase_(make_narrow_phase(*model_)) {
  const effects::StepPlan plan(*model_);
  all_bodies_.resize(model_->bodies.size());
  std::iota(all_bodies_.begin(), all_bodies_.end(), 0);
  if (plan.has(effects::EffectId::fast_bodies)) fast_bodies_.emplace(*model_);
  if (plan.has(effects::EffectId::field_of_interest)) field_.emplace(*model_, settings.iterations);
  if (fast_bodies_ || field_) before_step_ = state;
  if (plan.has(effects::EffectId::sleeping)) sleepers_.emplace(*model_, settings.dt_s);
  if (plan.has(effects::EffectId::breakable_joints)) breakage_.emplace(*model_);
  set_state(state, step);
}

void SorWorld::set_state(const model::State& state, std::int64_t step) {
  const bool other_joints_hold = state.broken_in != state_.broken_in;
  state_ = state;
  step_ = step;
  if (sleepers_) sleepers_->start(state_);
  if (breakage_) breakage_->start(state_);
  if (other_joints_hold) let_go();
  moved_ = true;
}

void SorWorld::show_awake(Pack& pack, int index) const {
  pack.set_awake(index, awake());
  activate(pack, index);
}

void SorWorld::load(Pack& pack, int index) const {
  pack.load(index, state_);
  pack.set_broken(index, state_.broken_in);
  if (sleepers_) show_awake(pack, index);
}

void SorWorld::enter(Pack& pack, int index) const {
  load(pack, index);
  apply_settings_before(*model_, step_, index, pack);
}

bool SorWorld::mends(const model::State& state) const {
  for (std::size_t joint = 0; joint < state_.broken_in.size(); ++joint) {
    if (state_.is_broken(joint) && !state.is_broken(joint)) return true;
  }
  return false;
}

void SorWorld::strain(Pack& pack, int index, const FocusedStep& step) {
  if (!breakage_) return;
  const auto reaction = [&](int joint) { return step.reaction(pack, index, joint); };
  if (!breakage_->strain(step_, breakage_->joints(), reaction, state_)) return;
  pack.set_broken(index, state_.broken_in);
  let_go();
}

/// Other joints are broken than before.
void SorWorld::let_go() {
  if (fast_bodies_) fast_bodies_->set_broken(state_.broken_in);
  if (field_) field_->set_broken(*model_, state_.broken_in);
}

void SorWorld::fire_events(Pack& pack, int index) {
  if (sleepers_ && sleepers_->wake(sleepers_->islands_called(step_, state_), state_)) show_awake(pack, index);
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

void SorWorld::focus(const Pack& pack, int index, std::span<const model::Contact> contacts) {
  if (!field_) return;
  if (!fast_bodies_ && moves()) pack.store(index, before_step_);  // look_ahead() has it already
  field_->look(before_step_.position);
  field_->sort(awake(), before_step_.position, contacts);
}

bool SorWorld::wake_touched(Pack& pack, int index, std::span<const model::Contact> contacts) {
  if (!sleepers_ || num_awake() == model_->num_bodies()) return false;
  if (!sleepers_->wake(effects::Sleepers::islands_touched(effects::touching_bodies(contacts), state_),
                       state_))
    return false;
  show_awake(pack, index);
  return true;
}

void SorWorld::settle(Pack& pack, int index, std::span<const model::Contact> contacts) {
  if (!sleepers_) return;
  pack.store(index, sleepers_->awake(), state_);
  sleepers_->count(sleepers_->awake(), state_);
  const std::vector<effects::Resting> resting =
      sleepers_->find_resting(sleepers_->awake(), effects::touching_bodies(contacts), state_);
  if (resting.empty()) return;
  sleepers_->put_to_sleep(resting, state_);
  std::vector<int> bodies;
  for (const effects::Resting& one : resting) bodies.push_back(one.body);
  pack.load(index, bodies, state_);
  show_awake(pack, index);
}

void SorWorld::keep_sleepers(model::State& state) const {
  for (int body = 0; sleepers_ && body < model_->num_bodies(); ++body) {
    if (state_.rest[body].asleep()) model::copy_body(body, state_, state);
  }
}

void SorWorld::count_rows(const Pack& pack, int index, const FocusedStep& step,
                          std::span<const model::Contact> contacts) {
  std::vector<std::pair<int, int>> links;
  std::vector<int> rows;
  for (std::size_t j = 0; j < model_->joints.size(); ++j) {
    if (!state_.acted_in(step_ - 1, j)) continue;
    links.emplace_back(model_->joints[j].body_a, model_->joints[j].body_b);
    const bool asleep = sleepers_ && state_.rest[model_->joints[j].body_a].asleep();
    rows.push_back(asleep ? 0 : step.joint_rows(pack, index, static_cast<int>(j)));
  }
  for (int body = 0; sleepers_ && body < model_->num_bodies(); ++body) {
    if (!state_.rest[body].asleep()) continue;
    links.emplace_back(body, state_.rest[body].island());
    rows.push_back(0);
  }
  for (const model::Contact& contact : contacts) {
    links.emplace_back(contact.body_a, contact.body_b);
    rows.push_back(model::contact_rows(contact.mu));
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

void SorWorld::observe(const Pack& pack, int index, const FocusedStep& step,
                       std::span<const model::Contact> contacts) {
  if (!std::exchange(moved_, false)) return stepping::observe_sleep(observables_);
  pack.store(index, state_);
  count_rows(pack, index, step, contacts);
  observables_.contacts = static_cast<int>(contacts.size());
  observables_.bodies_inside = field_ ? static_cast<int>(field_->inside().size()) : 0;
  observables_.max_penetration_m = 0;
  for (const model::Contact& contact : contacts) {
    observables_.max_penetration_m = std::max(observables_.max_penetration_m, contact.depth);
  }
  stepping::observe_state(*model_, state_, observables_);
}

}  // namespace pbmpi::solver
