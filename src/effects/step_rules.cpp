#include "effects/step_rules.h"

#include <numeric>

namespace pbmpi::effects {

StepRules::StepRules(const model::Model& model, double dt_s, std::optional<int> iterations, World world,
                     model::State& state, double most_approach_m)
    : model_(&model),
      dt_s_(dt_s),
      most_approach_m_(most_approach_m),
      state_(&state),
      all_bodies_(model.bodies.size()) {
  std::iota(all_bodies_.begin(), all_bodies_.end(), 0);
  const StepPlan plan(model);
  for (const Pass& pass : plan.passes()) {
    if (pass.effect->make_velocity_rule != nullptr)
      velocity_rules_.push_back(pass.effect->make_velocity_rule(model));
  }
  looks_ahead_ = plan.has(EffectId::fast_bodies) && world == World::whole;
  if (plan.has(EffectId::field_of_interest) && iterations) field_.emplace(model, *iterations);
  if (plan.has(EffectId::sleeping)) sleepers_.emplace(model, dt_s, state);
  if (plan.has(EffectId::breakable_joints)) breakage_.emplace(model);
  if (looks_ahead_ || field_ || !velocity_rules_.empty()) before_.resize(model.num_bodies());
}

bool StepRules::start() {
  has_before_ = false;
  if (sleepers_) sleepers_->start();
  if (breakage_) breakage_->start(*state_);
  std::vector<char> is_broken(model_->joints.size(), 0);
  for (std::size_t joint = 0; joint < is_broken.size(); ++joint) is_broken[joint] = state_->is_broken(joint);
  is_broken_.resize(is_broken.size(), 0);
  if (is_broken == is_broken_) return false;
  is_broken_ = std::move(is_broken);
  take_in_broken();
  return true;
}

void StepRules::begin_step(RuledWorld& world, std::int64_t step) {
  has_before_ = false;
  num_fast_ = 0;
  wake_called(world, step);
  world.fire_events(step);
  change_velocities(world);
}

bool StepRules::after_collision(RuledWorld& world) {
  look_ahead(world);
  return wake_touched(world);
}

void StepRules::before_solve(RuledWorld& world) { sort_by_interest(world); }

void StepRules::after_solve(RuledWorld& world, std::int64_t step) {
  break_overloaded_joints(world, step);
  fall_asleep(world);
}

void StepRules::sleep_on() {
  if (!field_) return;
  field_->look(before_.position);
  sort_by_interest({}, {});
}

void StepRules::wake_called(RuledWorld& world, std::int64_t step) {
  if (!sleepers_) return;
  const long before = sleepers_->revision();
  sleepers_->wake_called(step);
  if (sleepers_->revision() != before) world.show_awake();
}

void StepRules::change_velocities(std::span<const int> bodies, model::State& state) const {
  for (const VelocityRule& rule : velocity_rules_) rule(dt_s_, bodies, state);
}

void StepRules::change_velocities(RuledWorld& world) {
  if (velocity_rules_.empty() || all_asleep()) return;
  world.store(awake(), before_);
  change_velocities(awake(), before_);
  world.set_velocities(awake(), before_);
}

void StepRules::look_ahead(RuledWorld& world) {
  if (!looks_ahead_ || !world.may_be_fast()) return;
  if (!fast_bodies_) make_fast_bodies();
  world.store(all_bodies_, before_);
  has_before_ = true;
  if (fast_bodies_->look(before_, dt_s_)) world.add_speculative_contacts(*fast_bodies_, before_);
  num_fast_ = static_cast<int>(fast_bodies_->bodies().size());
}

void StepRules::make_fast_bodies() {
  fast_bodies_.emplace(*model_, most_approach_m_);
  fast_bodies_->set_broken(state_->broken_in);
}

bool StepRules::wake_touched(RuledWorld& world) {
  if (!sleepers_ || sleepers_->awake().size() == all_bodies_.size()) return false;
  if (!sleepers_->wake(Sleepers::islands_touched(world.touching(), *state_))) return false;
  world.show_awake();
  return true;
}

void StepRules::sort_by_interest(RuledWorld& world) {
  if (!field_) return;
  if (!has_before_ && !all_asleep()) world.store(all_bodies_, before_);
  field_->look(before_.position);
  field_->sort(awake(), before_.position, world.touching());
}

void StepRules::sort_by_interest(std::span<const int> bodies, std::span<const BodyPair> touching) {
  if (field_) field_->sort(bodies, state_->position, touching);
}

void StepRules::break_overloaded_joints(RuledWorld& world, std::int64_t step) {
  const auto reaction = [&](int joint) { return world.reaction(joint); };
  if (break_overloaded_joints(step, breakable_joints(), reaction)) world.show_broken();
}

bool StepRules::break_overloaded_joints(std::int64_t step, std::span<const int> joints,
                                        const Breakage::GetReaction& reaction) {
  if (!breakage_ || !breakage_->break_overloaded_joints(step, joints, reaction, *state_)) return false;
  take_in_broken();
  return true;
}

void StepRules::take_in_broken() {
  is_broken_.resize(model_->joints.size());
  for (std::size_t joint = 0; joint < is_broken_.size(); ++joint)
    is_broken_[joint] = state_->is_broken(joint) ? 1 : 0;
  if (fast_bodies_) fast_bodies_->set_broken(state_->broken_in);
  if (field_) field_->set_broken(*model_, state_->broken_in);
}

void StepRules::fall_asleep(RuledWorld& world) {
  if (!sleepers_) return;
  world.store(awake(), *state_);
  const auto is_driven = [&](int joint) { return world.is_driven(joint); };
  const std::vector<Resting> resting =
      Sleepers::join(model_->num_bodies(), sleepers_->find_resting(awake(), world.touching(), is_driven), {});
  if (resting.empty()) return;
  sleepers_->put_to_sleep(resting);
  std::vector<int> bodies;
  bodies.reserve(resting.size());
  for (const Resting& one : resting) bodies.push_back(one.body);
  world.show_asleep(bodies);
}

}  // namespace pbmpi::effects
