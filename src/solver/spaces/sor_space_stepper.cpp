// Long because it is the whole of one interface (stepping::SpaceStepper); its parts are in files beside it.
#include "solver/spaces/sor_space_stepper.h"

#include <algorithm>
#include <optional>

#include "effects/motors.h"
#include "effects/step_rules.h"
#include "solver/contacts/contact_recall.h"
#include "solver/layout/articulation.h"
#include "solver/pack/simd.h"
#include "solver/pack/step_settings.h"
#include "solver/parts/parted_step.h"
#include "solver/spaces/active_units.h"
#include "solver/spaces/cross_broad_phase.h"
#include "solver/spaces/island_counts.h"
#include "solver/spaces/own_first.h"
#include "solver/spaces/packed_state.h"
#include "solver/spaces/space_bodies.h"
#include "solver/spaces/space_fast_bodies.h"
#include "solver/spaces/unit_memory.h"

namespace pbmpi::solver {
namespace {

using model::Contact;
using model::Event;
using model::EventKind;

class SorSpaceStepper final : public stepping::SpaceStepper {
 public:
  SorSpaceStepper(const stepping::StepperSettings& settings, const model::MakeNarrowPhase& make_narrow_phase,
                  std::shared_ptr<const model::Model> model);

  const model::Model& model() const override { return *model_; }
  const model::SpaceMap& map() const override { return map_; }
  const model::State& state() const override { return packed_.state(); }
  effects::SpaceSleepers* sleepers() override { return rules_.sleepers(); }
  effects::FieldOfInterest* field() override { return rules_.field(); }
  int num_lanes() const override { return solver::num_lanes(simd(), settings_.precision); }
  void own(std::span<const int> spaces, const model::State& state, std::int64_t step) override;
  void put_states(std::span<const int> bodies, std::span<const double> rows) override {
    packed_.put_states(bodies, rows);
  }
  std::vector<std::int32_t> broken_rows(std::span<const int> units) const override;
  void put_broken(std::span<const int> units, std::span<const std::int32_t> rows) override;
  bool remembers() const override { return solver::remembers(settings_); }
  std::vector<double> memory_rows(std::span<const int> units) const override {
    return UnitMemory{map_, articulations_}.rows(units, state().memory);
  }
  void put_memory(std::span<const int> units, std::span<const double> rows) override {
    UnitMemory{map_, articulations_}.put(units, rows, model_->joints.size(), packed_.state().memory);
  }
  void fire_events(std::int64_t step) override;
  void launch_others(std::int64_t step) override;
  bool has_velocity_rules() const override { return rules_.changes_velocities(); }
  void collide(std::vector<Contact>& contacts) override;
  std::vector<geometry::Box> space_boxes(std::span<const int> spaces) override;
  std::vector<int> near_spaces(std::span<const int> owner, std::span<const geometry::Box> boxes) override {
    return cross_.near_spaces(owner, boxes);
  }
  void collide_across(std::span<const int> owner, std::span<const geometry::Box> boxes,
                      std::vector<Contact>& contacts) override;
  void solve(std::span<const int> units, std::span<const Contact> contacts, std::int64_t step,
             core::PhaseTimes& times) override;
  stepping::Observables count(std::span<const int> units) const override;
  bool shows_contacts() const override { return settings_.contacts; }
  stepping::StepContacts contacts_of(std::span<const int> units) const override;

 private:
  stepping::Simd simd() const {
    return settings_.simd == stepping::Simd::automatic ? best_simd() : settings_.simd;
  }
  std::vector<PackedWorld> packed_own_first() const;
  std::vector<int> bodies_of(std::span<const int> spaces) const;  ///< with a geom
  bool is_own(int body) const { return is_own_[map_.space_of_body(body)] != 0; }
  void activate(std::span<const int> units);
  /// Finds which islands get different shares of the step.
  void part(std::span<const Contact> contacts, const StepParameters& parameters);
  void recall(std::span<const Contact> contacts);
  bool is_awake(int body) const { return rules_.sleepers() == nullptr || !rules_.sleepers()->asleep(body); }
  /// Applies the velocity rules to the awake bodies of own spaces, or to those of other ranks.
  void change_velocities(bool own);
  void show_sleepers();
  void show_broken();
  void break_overloaded_joints(std::int64_t step);
  void collide_pairs(std::vector<Contact>& contacts);

  stepping::StepperSettings settings_;
  std::shared_ptr<const model::Model> model_;
  model::SpaceMap map_;
  std::vector<Articulation> articulations_;
  std::unique_ptr<model::NarrowPhase> narrow_phase_;
  SpaceBodies bodies_;
  CrossBroadPhase cross_;
  std::unique_ptr<Pack> pack_;
  PackedState packed_;
  effects::StepRules rules_;       ///< those of a cut world: the ranks agree between their parts
  long shown_revision_ = -1;       ///< revision of the sleepers that the pack knows
  std::vector<char> is_own_;       ///< [num_spaces]
  std::vector<int> own_bodies_;    ///< ascending
  std::vector<int> other_bodies_;  ///< ascending
  ActiveUnits active_;             ///< units of the last solve()
  std::vector<model::GeomPair> pairs_;
  std::optional<SpaceFastBodies> fast_bodies_;  ///< none without the pass
  PartedStep parted_;                           ///< the step of the last solve()
  std::vector<Contact> contacts_;               ///< with which the last solve() ended
  ContactRecall recall_;                        ///< their forces
  std::optional<IslandShares> shares_;          ///< none where all islands get the same
  model::State after_;                          ///< with shares: see PartedWorld
  int fast_own_bodies_ = 0;                     ///< in the last step
  int bodies_inside_ = 0;                       ///< of the last solve()
  std::int64_t last_step_ = 0;                  ///< the last step solved
  std::optional<std::int64_t> launched_step_;   ///< step of the last launch_others()
};

SorSpaceStepper::SorSpaceStepper(const stepping::StepperSettings& settings,
                                 const model::MakeNarrowPhase& make_narrow_phase,
                                 std::shared_ptr<const model::Model> model)
    : settings_(settings),
      model_(std::move(model)),
      map_(model::make_space_map(*model_)),
      articulations_(find_articulations(*model_)),
      narrow_phase_(make_fallback(settings, *model_, make_narrow_phase)),
      bodies_(*model_, map_, contact_margin_m(settings, *model_)),
      cross_(*model_, bodies_),
      packed_(*model_),
      rules_(*model_, settings.dt_s, settings.iterations, effects::StepRules::World::cut, packed_.state(),
             most_approach_m(settings)),
      active_(map_),
      shares_(IslandShares::find(*model_, settings)) {
  if (effects::StepPlan(*model_).has(effects::EffectId::fast_bodies))
    fast_bodies_.emplace(*model_, map_, settings.dt_s, most_approach_m(settings));
  rules_.start();
}

std::vector<PackedWorld> SorSpaceStepper::packed_own_first() const {
  std::vector<PackedWorld> packed = {pack_own_first(*model_, map_, articulations_, is_own_)};
  packed[0].fallback = narrow_phase_.get();
  packed[0].lanes_collide = settings_.law.colliders == stepping::Colliders::lanes;
  packed[0].most_approach_m = most_approach_m(settings_);
  packed[0].in_parts = shares_.has_value();
  packed[0].contact_margin_m = contact_margin_m(settings_, *model_);
  return packed;
}

void SorSpaceStepper::own(std::span<const int> spaces, const model::State& state, std::int64_t step) {
  is_own_.assign(static_cast<std::size_t>(map_.num_spaces()), 0);
  for (const int space : spaces) is_own_[space] = 1;
  own_bodies_.clear();
  other_bodies_.clear();
  for (int body = 0; body < model_->num_bodies(); ++body)
    (is_own(body) ? own_bodies_ : other_bodies_).push_back(body);
  launched_step_.reset();
  if (fast_bodies_) fast_bodies_->own(own_bodies_);
  pack_ = make_pack(packed_own_first(), settings_.simd, settings_.precision);
  packed_.start(state, *pack_);
  start_memory(remembers(), *model_, packed_.state().memory);
  rules_.start();
  shown_revision_ = -1;
  active_.clear();
  pack_->set_active(0, active_.bodies());
  apply_settings_before(*model_, step, 0, *pack_);
  show_broken();
}

/// Sleeping bodies have other velocities than the pack knows.
void SorSpaceStepper::show_sleepers() {
  const effects::SpaceSleepers* sleepers = rules_.sleepers();
  if (sleepers == nullptr || shown_revision_ == sleepers->revision()) return;
  shown_revision_ = sleepers->revision();
  pack_->set_awake(0, sleepers->awake());
  for (int body = 0; body < model_->num_bodies(); ++body) {
    if (sleepers->asleep(body)) packed_.touch(body);
  }
}

void SorSpaceStepper::show_broken() {
  const std::vector<std::int32_t>& broken_in = state().broken_in;
  pack_->set_broken(0, broken_in);
  if (fast_bodies_) fast_bodies_->set_broken(broken_in);
}

void SorSpaceStepper::break_overloaded_joints(std::int64_t step) {
  std::vector<int> joints;
  for (const int joint : rules_.breakable_joints()) {
    const int unit = map_.unit_of_body[model_->joints[joint].body_a];
    if (active_.contains(unit)) joints.push_back(joint);
  }
  const auto reaction = [&](int joint) { return parted_.reaction(*pack_, 0, joint); };
  if (rules_.break_overloaded_joints(step, joints, reaction)) show_broken();
}

std::vector<std::int32_t> SorSpaceStepper::broken_rows(std::span<const int> units) const {
  std::vector<std::int32_t> rows;
  if (!rules_.joints_can_break()) return rows;
  for (const int unit : units) {
    for (const int joint : articulations_[unit].joints) rows.push_back(state().broken_in[joint]);
  }
  return rows;
}

void SorSpaceStepper::put_broken(std::span<const int> units, std::span<const std::int32_t> rows) {
  std::vector<std::int32_t>& broken_in = packed_.state().broken_in;
  auto row = rows.begin();
  bool changed = false;
  for (const int unit : units) {
    for (const int joint : articulations_[unit].joints) {
      changed |= broken_in[joint] != *row;
      broken_in[joint] = *row++;
    }
  }
  if (!changed) return;
  rules_.take_in_broken();
  show_broken();
}

void SorSpaceStepper::change_velocities(bool own) {
  if (!rules_.changes_velocities()) return;
  std::vector<int> bodies = own ? own_bodies_ : other_bodies_;
  std::erase_if(bodies, [&](int body) { return !is_awake(body); });
  rules_.change_velocities(bodies, packed_.state());
  for (const int body : bodies) packed_.launch(velocity_event(body, state()), *pack_);
}

void SorSpaceStepper::fire_events(std::int64_t step) {
  fast_own_bodies_ = bodies_inside_ = 0;  // while all sleep nothing collides, and there is no solve()
  show_sleepers();
  if (rules_.sleepers() != nullptr) rules_.sleepers()->wake_called(step);
  for (const Event& event : effects::events_of(*model_, step)) {
    apply_setting(event, 0, *pack_);
    if (event.kind != EventKind::launch) continue;
    if (is_own(event.body)) packed_.launch(event, *pack_);
    pack_->forget(0, event.body);
    if (is_own(event.body)) model::forget(*model_, event.body, packed_.state().memory);
  }
  change_velocities(true);
}

/// Acts once a step: a second launch would undo the rules' changes of the first launch's velocity.
void SorSpaceStepper::launch_others(std::int64_t step) {
  if (launched_step_ == step) return;
  launched_step_ = step;
  for (const Event& event : effects::events_of(*model_, step)) {
    if (event.kind != EventKind::launch || is_own(event.body)) continue;
    packed_.launch(event, *pack_);
  }
  change_velocities(false);
}

void SorSpaceStepper::collide(std::vector<Contact>& contacts) {
  contacts.clear();
  if (std::none_of(own_bodies_.begin(), own_bodies_.end(), [&](int body) { return is_awake(body); })) return;
  show_sleepers();
  packed_.lend(own_bodies_, *pack_);
  pack_->collide(std::span(&contacts, 1));
  if (fast_bodies_) fast_own_bodies_ = fast_bodies_->add_own(state(), contacts);
}

void SorSpaceStepper::collide_pairs(std::vector<Contact>& contacts) {
  std::vector<int> bodies;
  for (const model::GeomPair& pair : pairs_) {
    for (const int geom : {pair.first, pair.second}) {
      if (const int body = model_->geoms[geom].body; body != model::no_body) bodies.push_back(body);
    }
  }
  packed_.lend(bodies, *pack_);
  pack_->collide_pairs(0, pairs_, contacts);
}

std::vector<geometry::Box> SorSpaceStepper::space_boxes(std::span<const int> spaces) {
  std::vector<geometry::Box> all(static_cast<std::size_t>(map_.num_spaces()));
  for (const int space : spaces) all[space] = bodies_.space_box(space, packed_.poses());
  if (fast_bodies_) fast_bodies_->widen(state(), bodies_of(spaces), all);
  std::vector<geometry::Box> boxes;
  for (const int space : spaces) boxes.push_back(all[space]);
  return boxes;
}

std::vector<int> SorSpaceStepper::bodies_of(std::span<const int> spaces) const {
  std::vector<int> bodies;
  for (const int space : spaces)
    bodies.insert(bodies.end(), bodies_.bodies(space).begin(), bodies_.bodies(space).end());
  return bodies;
}

void SorSpaceStepper::collide_across(std::span<const int> owner, std::span<const geometry::Box> boxes,
                                     std::vector<Contact>& contacts) {
  contacts.clear();
  if (rules_.all_asleep()) return;
  cross_.find_pairs(owner, boxes, packed_.poses(), pairs_);
  std::erase_if(pairs_, [&](const model::GeomPair& pair) {
    return !is_awake(model_->geoms[pair.first].body) && !is_awake(model_->geoms[pair.second].body);
  });
  collide_pairs(contacts);
  if (fast_bodies_) fast_bodies_->add_across(state(), bodies_of(cross_.near_spaces()), owner, contacts);
}

void SorSpaceStepper::activate(std::span<const int> units) {
  const bool may_sleep_in_part = rules_.sleepers() != nullptr && rules_.joints_can_break();
  if (!active_.set(units, rules_.sleepers(), may_sleep_in_part)) return;
  pack_->set_active(0, active_.bodies());
  packed_.activate(active_.bodies());
}

void SorSpaceStepper::part(std::span<const Contact> contacts, const StepParameters& parameters) {
  if (rules_.field() != nullptr)
    rules_.sort_by_interest(active_.bodies(), effects::touching_bodies(contacts));
  bodies_inside_ = rules_.num_inside();
  PartedWorld world = {.model = model_.get(),
                       .bodies = active_.bodies(),
                       .contacts = {contacts, recall_.forces()},
                       .field = rules_.field()};
  if (shares_) {
    shares_->sort(active_.bodies(), contacts, state().broken_in, state());
    after_.resize(model_->num_bodies());
    world.shares = &*shares_;
    world.before = &state();
    world.after = &after_;
  }
  parted_.begin(std::span(&world, 1), parameters);
}

/// Forces of own units and guests that sleep stay as they are. Those of own units that are solved elsewhere
/// come back with them, and others' are none of this rank's (a contact belongs to the unit of its first
/// body).
void SorSpaceStepper::recall(std::span<const Contact> contacts) {
  const auto sleeps = [&](int body) { return body != model::no_body && !is_awake(body); };
  recall_.recall(
      contacts, state().memory.contacts, [&](int body) { return state().position[body]; },
      [&](const model::ContactForce& old) {
        const bool belongs_here = is_own(old.body_a) || active_.contains(map_.unit_of_body[old.body_a]);
        return belongs_here && (sleeps(old.body_a) || sleeps(old.body_b));
      });
}

void SorSpaceStepper::solve(std::span<const int> units, std::span<const Contact> contacts, std::int64_t step,
                            core::PhaseTimes& times) {
  core::LapTimer timer(times);
  show_sleepers();
  activate(units);
  if (remembers() || settings_.contacts) recall(contacts);
  part(contacts, step_parameters(settings_, step));
  contacts_.assign(contacts.begin(), contacts.end());
  if (rules_.sleepers() != nullptr && active_.bodies().empty()) return;
  packed_.load(active_.bodies(), *pack_);
  timer.lap(core::Phase::rows);
  parted_.take(*pack_, times);
  core::LapTimer after(times);
  last_step_ = step;
  if (parted_.has_fine(0)) {
    const model::SolvedContacts ended = parted_.ended(0);
    contacts_.assign(ended.contacts.begin(), ended.contacts.end());
    recall_.replace(ended.forces);
  }
  if (remembers()) recall_.store(packed_.state().memory.contacts);
  break_overloaded_joints(step);
  // A pack with sleepers puts back the other bodies.
  packed_.store(active_.bodies(), *pack_, rules_.sleepers() != nullptr);
  if (parted_.is_cut()) pack_->set_active(0, active_.bodies());
  after.lap(core::Phase::integrate);
}

stepping::Observables SorSpaceStepper::count(std::span<const int> units) const {
  const auto joint_rows = [&](int joint) -> std::optional<int> {
    if (!state().acted_in(last_step_, static_cast<std::size_t>(joint))) return std::nullopt;
    return parted_.joint_rows(*pack_, 0, joint);
  };
  stepping::Observables counts = count_islands(
      *model_, map_, articulations_, units, contacts_, joint_rows,
      [&](int body) { return parted_.sweeps(0, body); }, rules_.sleepers());
  counts.fast_bodies = fast_own_bodies_;
  counts.bodies_inside = bodies_inside_;
  return counts;
}

stepping::StepContacts SorSpaceStepper::contacts_of(std::span<const int> units) const {
  stepping::StepContacts shown;
  shown.contacts = recall_.loaded(contacts_);
  model::State stored;
  stored.resize(model_->num_bodies());
  stored.memory.joints.resize(model_->joints.size());
  pack_->store(0, stored);
  shown.joints.resize(model_->joints.size());
  for (const int unit : units) {
    for (const int joint : articulations_[unit].joints)
      shown.joints[joint] = stored.memory.joints[static_cast<std::size_t>(joint)];
  }
  return shown;
}

}  // namespace

std::unique_ptr<stepping::SpaceStepper> make_sor_space_stepper(
    const stepping::StepperSettings& settings, const model::MakeNarrowPhase& make_narrow_phase,
    std::shared_ptr<const model::Model> model) {
  require_valid(settings);
  return std::make_unique<SorSpaceStepper>(settings, make_narrow_phase, std::move(model));
}

}  // namespace pbmpi::solver
