#include "solver/worlds/sor_world.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "effects/motors.h"
#include "solver/pack/step_settings.h"
#include "stepping/observable_table.h"

namespace pbmpi::solver {

/// The world in its place in a pack, during the current step.
class SorWorld::InPack final : public effects::RuledWorld {
 public:
  InPack(SorWorld& world, Pack& pack, int index, std::vector<model::Contact>* contacts,
         const PartedStep* solved, bool may_be_fast = false)
      : world_(world),
        pack_(pack),
        index_(index),
        contacts_(contacts),
        solved_(solved),
        may_be_fast_(may_be_fast) {}

  void fire_events(std::int64_t step) override {
    for (const model::Event& event : effects::events_of(*world_.model_, step)) {
      apply_setting(event, index_, pack_);
      if (event.kind != model::EventKind::launch) continue;
      pack_.launch(index_, event);
      pack_.forget(index_, event.body);
      world_.forget(event.body);
    }
    world_.targets_.pass(*world_.model_, step);
  }
  void store(std::span<const int> bodies, model::State& state) const override {
    pack_.store(index_, bodies, state);
  }
  void set_velocities(std::span<const int> bodies, const model::State& state) override {
    for (const int body : bodies) pack_.launch(index_, velocity_event(body, state));
  }
  bool may_be_fast() const override { return may_be_fast_; }
  void add_speculative_contacts(effects::FastBodies& fast, const model::State& before) override {
    fast.add(
        before, [](int, int) { return true; }, *contacts_);
  }
  std::span<const effects::BodyPair> touching() override {
    touching_ = effects::touching_bodies(*contacts_);
    return touching_;
  }
  effects::Reaction reaction(int joint) const override { return solved_->reaction(pack_, index_, joint); }
  bool is_driven(int joint) const override {
    return world_.targets_.drive(*world_.model_, world_.step_ + 1, joint);
  }
  void show_awake() override { world_.show_awake(pack_, index_); }
  void show_asleep(std::span<const int> bodies) override {
    pack_.load(index_, bodies, world_.state_);
    show_awake();
  }
  void show_broken() override { pack_.set_broken(index_, world_.state_.broken_in); }

 private:
  SorWorld& world_;
  Pack& pack_;
  int index_;
  std::vector<model::Contact>* contacts_;  ///< null before collision detection
  const PartedStep* solved_;               ///< null before the solve
  bool may_be_fast_;                       ///< see Pack::find_fast()
  std::vector<effects::BodyPair> touching_;
};

SorWorld::SorWorld(int id, std::shared_ptr<const model::Model> model, const model::State& state,
                   std::int64_t step, const stepping::StepperSettings& settings,
                   const model::MakeNarrowPhase& make_narrow_phase)
    : id_(id),
      model_(std::move(model)),
      laws_(laws_of(*model_)),
      state_(state),
      step_(step),
      rules_(*model_, settings.dt_s, settings.iterations, effects::StepRules::World::whole, state_,
             most_approach_m(settings)),
      narrow_phase_(make_fallback(settings, *model_, make_narrow_phase)),
      remembers_(remembers(settings)),
      shows_contacts_(settings.contacts),
      shares_(IslandShares::find(*model_, settings)),
      observer_(*model_) {
  for (const model::Joint& joint : model_->joints) jointed_.emplace_back(joint.body_a, joint.body_b);
  set_state(state, step);
}

void SorWorld::set_state(const model::State& state, std::int64_t step) {
  state_ = state;
  if (std::exchange(step_, step) != step) targets_.move_to(*model_, step);
  start_memory(remembers_, *model_, state_.memory);
  rules_.start();
  moved_ = true;
}

void SorWorld::show_awake(Pack& pack, int index) const {
  pack.set_awake(index, rules_.awake());
  activate(pack, index);
}

void SorWorld::load(Pack& pack, int index) const {
  pack.load(index, state_);
  pack.set_broken(index, state_.broken_in);
  if (rules_.sleepers() != nullptr) show_awake(pack, index);
}

void SorWorld::enter(Pack& pack, int index) const {
  load(pack, index);
  apply_first_settings(*model_, index, pack);
  apply_settings_before(*model_, step_, index, pack);
  for (const stepping::MotorTargets::Target& target : targets_.all())
    pack.set_motor(index, target.joint, target.axis, target.motor);
  for (const auto& [body, load] : loads_) pack.set_load(index, body, load);
}

void SorWorld::aim(int joint, int axis, double velocity, Pack* pack, int index) {
  const auto* target = targets_.set(*model_, step_, joint, axis, velocity);
  if (target == nullptr) return;
  if (pack != nullptr) pack->set_motor(index, joint, axis, target->motor);
  const model::Joint& driven = model_->joints[static_cast<std::size_t>(joint)];
  wake(std::array{driven.body_a, driven.body_b}, pack, index);
}

void SorWorld::push(int body, const stepping::BodyLoad& load, Pack* pack, int index) {
  const auto known = loads_.find(body);
  if (load == (known == loads_.end() ? stepping::BodyLoad{} : known->second)) return;
  loads_[body] = load;
  if (pack != nullptr) pack->set_load(index, body, load);
  wake(std::array{body}, pack, index);
}

void SorWorld::wake(std::span<const int> bodies, Pack* pack, int index) {
  if (rules_.sleepers() == nullptr) return;
  const bool woke = rules_.sleepers()->wake_islands_of(bodies);
  if (woke && pack != nullptr) show_awake(*pack, index);
}

bool SorWorld::mends(const model::State& state) const {
  for (std::size_t joint = 0; joint < state_.broken_in.size(); ++joint) {
    if (state_.is_broken(joint) && !state.is_broken(joint)) return true;
  }
  return false;
}

void SorWorld::begin_step(Pack& pack, int index) {
  InPack world(*this, pack, index, nullptr, nullptr);
  rules_.begin_step(world, step_);
}

bool SorWorld::after_collision(Pack& pack, int index, bool may_be_fast,
                               std::vector<model::Contact>& contacts) {
  InPack world(*this, pack, index, &contacts, nullptr, may_be_fast);
  return rules_.after_collision(world);
}

void SorWorld::before_solve(Pack& pack, int index, bool may_be_slow, std::vector<model::Contact>& contacts) {
  InPack world(*this, pack, index, &contacts, nullptr);
  rules_.before_solve(world);
  if (remembers_ || shows_contacts_) recall(pack, index, contacts);
  sorted_ = shares_ && (may_be_slow || shares_->may_add_substeps() || shares_->may_cut(contacts));
  if (sorted_) sort_islands(pack, index, contacts);
}

/// A trial of quiet islands may have to put back the forces of their joints too.
void SorWorld::sort_islands(const Pack& pack, int index, std::span<const model::Contact> contacts) {
  const std::size_t num_forces = state_.memory.joints.size();
  if (shares_->wants_state()) {
    for (model::State* room : {&before_, &after_}) room->resize(model_->num_bodies());
    before_.memory.joints.clear();
    pack.store(index, rules_.awake(), before_);
  }
  shares_->sort(rules_.awake(), contacts, state_.broken_in, before_);
  if (!shares_->wants_state()) return;
  before_.memory.joints.resize(num_forces);
  pack.store(index, shares_->quiet_bodies(), before_);
}

PartedWorld SorWorld::parted(std::span<const model::Contact> contacts) {
  return {.model = model_.get(),
          .bodies = rules_.awake(),
          .contacts = {contacts, recall_.forces()},
          .field = rules_.field(),
          .shares = sorted_ ? &*shares_ : nullptr,
          .before = &before_,
          .after = &after_};
}

void SorWorld::recall(const Pack& pack, int index, std::span<const model::Contact> contacts) {
  const auto is_asleep = [&](int body) {
    return rules_.sleepers() != nullptr && body != model::no_body && state_.rest[body].asleep();
  };
  recall_.recall(
      contacts, state_.memory.contacts, [&](int body) { return pack.centre(index, body); },
      [&](const model::ContactForce& old) { return is_asleep(old.body_a) || is_asleep(old.body_b); });
}

void SorWorld::after_solve(Pack& pack, int index, std::vector<model::Contact>& contacts, PartedStep& step) {
  moved_ = moved_ || moves();
  if (step.has_fine(index)) recall_.replace(step.ended(index).forces);
  if (remembers_) recall_.store(state_.memory.contacts);
  if (step.is_cut()) activate(pack, index);
  InPack world(*this, pack, index, &contacts, &step);
  rules_.after_solve(world, step_);
  if (step.has_fine(index))
    contacts.assign(step.ended(index).contacts.begin(), step.ended(index).contacts.end());
  ++step_;
}

void SorWorld::sleep_on() {
  rules_.sleep_on();
  ++step_;
}

void SorWorld::count_rows(const Pack& pack, int index, const PartedStep& step,
                          std::span<const model::Contact> contacts) {
  const bool may_sleep = rules_.sleepers() != nullptr;
  island_rows_.reset(model_->num_bodies());
  for (std::size_t joint = 0; joint < jointed_.size(); ++joint) {
    if (!state_.acted_in(step_ - 1, joint)) continue;
    const auto [body_a, body_b] = jointed_[joint];
    island_rows_.join(body_a, body_b);
    if (may_sleep && state_.rest[body_a].asleep()) continue;
    island_rows_.add(body_a, step.joint_rows(pack, index, static_cast<int>(joint)));
  }
  for (int body = 0; may_sleep && body < model_->num_bodies(); ++body) {
    if (state_.rest[body].asleep()) island_rows_.join(body, state_.rest[body].island());
  }
  for (const model::Contact& contact : contacts) {
    island_rows_.join(contact.body_a, contact.body_b);
    island_rows_.add(contact.body_a, model::contact_rows(contact.mu));
  }
  island_rows_.count(
      rules_.all_bodies(), [&](int body) { return step.sweeps(index, body); }, observables_);
}

/// While the whole pack sleeps there are no contacts, and the forces are those of an older step.
void SorWorld::show_contacts(const Pack& pack, int index, std::span<const model::Contact> contacts) {
  shown_.contacts = recall_.loaded(contacts);
  model::State stored;
  stored.resize(model_->num_bodies());
  stored.memory.joints.resize(model_->joints.size());
  pack.store(index, stored);
  shown_.joints = std::move(stored.memory.joints);
}

void SorWorld::observe(const Pack& pack, int index, const PartedStep& step,
                       std::span<const model::Contact> contacts) {
  if (shows_contacts_) show_contacts(pack, index, contacts);
  if (!std::exchange(moved_, false)) return stepping::observe_sleep(observables_);
  pack.store(index, state_);
  count_rows(pack, index, step, contacts);
  observables_.contacts = static_cast<int>(contacts.size());
  observables_.fast_bodies = rules_.num_fast();
  observables_.bodies_inside = rules_.num_inside();
  observables_.max_penetration_m = 0;
  for (const model::Contact& contact : contacts) {
    observables_.max_penetration_m = std::max(observables_.max_penetration_m, contact.depth);
  }
  observer_.observe(state_, observables_);
}

}  // namespace pbmpi::solver
