/// The rules that act around a world's step, and their order.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <vector>

#include "effects/breakage.h"
#include "effects/effects.h"
#include "effects/fast_bodies.h"
#include "effects/field_of_interest.h"
#include "effects/space_sleepers.h"
#include "model/state.h"

namespace pbmpi::effects {

/// What the rules ask of the engine that steps a whole world. Bodies and joints are those of the model.
class RuledWorld {
 public:
  /// Launches bodies, and sets motors and limits; the release of joints is left to a rule.
  virtual void fire_events(std::int64_t step) = 0;
  /// Copies poses and velocities of these bodies, or of more, into `state`.
  virtual void store(std::span<const int> bodies, model::State& state) const = 0;
  /// Gives these bodies the velocities in `state`.
  virtual void set_velocities(std::span<const int> bodies, const model::State& state) = 0;
  /// False if no geom can be fast in the current step (SlowBound), after its events.
  virtual bool may_be_fast() const = 0;
  /// Adds the speculative contacts that `fast` finds in `before`, the state at the step's start.
  virtual void add_speculative_contacts(FastBodies& fast, const model::State& before) = 0;
  /// The contacts of the current step, speculative ones included; valid until the next call.
  virtual std::span<const BodyPair> touching() = 0;
  /// What a joint exerted in the step just solved.
  virtual Reaction reaction(int joint) const = 0;
  /// Does a motor of the joint aim at a velocity, after the events of the current step (effects/motors.h)?
  virtual bool is_driven(int joint) const = 0;
  /// The set of awake bodies has changed (StepRules::awake()).
  virtual void show_awake() = 0;
  /// These bodies fell asleep; in the world's state their velocities are zero.
  virtual void show_asleep(std::span<const int> bodies) = 0;
  /// The set of broken joints has changed (State::broken_in of the world's state).
  virtual void show_broken() = 0;

 protected:
  ~RuledWorld() = default;
};

/// Holds the rules that a model's StepPlan calls for, and applies them at four points of a step: an engine
/// that steps a whole world calls begin_step(), collides until after_collision() is false, calls
/// before_solve(), solves, and calls after_solve(). The rules and their order are the business of this class
/// alone.
///
/// The ranks that share a cut world have to agree between the rules, so its engine applies the parts itself,
/// at the same points: change_velocities(), sort_by_interest(), break_overloaded_joints(), and sleepers(),
/// which the ranks update together. Each rank's SpaceFastBodies finds the speculative contacts.
class StepRules {
 public:
  enum class World { whole, cut };

  /// All are borrowed; `state` is the world's, whose `rest` and `broken_in` the rules maintain. `iterations`:
  /// the run's; none for an engine without iterations, which has no field of interest either.
  /// `most_approach_m`: see FastBodies; infinite for an engine without shorter steps.
  StepRules(const model::Model& model, double dt_s, std::optional<int> iterations, World world,
            model::State& state, double most_approach_m = model::infinity);
  StepRules(const StepRules&) = delete;
  StepRules& operator=(const StepRules&) = delete;

  /// Takes in a new state; completes its `rest` and `broken_in`. True if the set of broken joints has
  /// changed.
  bool start();

  void begin_step(RuledWorld& world, std::int64_t step);
  /// True if bodies woke whose own contacts are still to be found: collide again.
  [[nodiscard]] bool after_collision(RuledWorld& world);
  void before_solve(RuledWorld& world);
  void after_solve(RuledWorld& world, std::int64_t step);
  /// Ends a step in which all bodies slept after begin_step().
  void sleep_on();

  /// The parts for a cut world. `bodies` are awake; their velocities in `state` are changed.
  bool changes_velocities() const { return !velocity_rules_.empty(); }
  void change_velocities(std::span<const int> bodies, model::State& state) const;
  void sort_by_interest(std::span<const int> bodies, std::span<const BodyPair> touching);
  /// True if any of these joints, which took part in the step, broke.
  bool break_overloaded_joints(std::int64_t step, std::span<const int> joints,
                               const Breakage::GetReaction& reaction);
  /// Call it after State::broken_in was changed from elsewhere.
  void take_in_broken();

  std::span<const int> all_bodies() const { return all_bodies_; }
  std::span<const int> awake() const { return sleepers_ ? sleepers_->awake() : all_bodies_; }
  bool all_asleep() const { return sleepers_ && sleepers_->all_asleep(); }
  std::span<const int> breakable_joints() const {
    return breakage_ ? breakage_->joints() : std::span<const int>();
  }
  /// Bodies that are fast in the current step, from after_collision() on; 0 for a cut world.
  int num_fast() const { return num_fast_; }
  int num_inside() const { return field_ ? static_cast<int>(field_->inside().size()) : 0; }
  bool joints_can_break() const { return breakage_.has_value(); }

  /// Null without their effects.
  SpaceSleepers* sleepers() { return sleepers_ ? &*sleepers_ : nullptr; }
  const SpaceSleepers* sleepers() const { return sleepers_ ? &*sleepers_ : nullptr; }
  FieldOfInterest* field() { return field_ ? &*field_ : nullptr; }
  const FieldOfInterest* field() const { return field_ ? &*field_ : nullptr; }

 private:
  void wake_called(RuledWorld& world, std::int64_t step);
  void change_velocities(RuledWorld& world);
  void look_ahead(RuledWorld& world);
  void make_fast_bodies();
  bool wake_touched(RuledWorld& world);
  void sort_by_interest(RuledWorld& world);
  void break_overloaded_joints(RuledWorld& world, std::int64_t step);
  void fall_asleep(RuledWorld& world);

  const model::Model* model_;
  double dt_s_;
  double most_approach_m_;
  model::State* state_;
  std::vector<int> all_bodies_;
  std::vector<VelocityRule> velocity_rules_;
  bool looks_ahead_ = false;               ///< false without the pass, or in a cut world
  std::optional<FastBodies> fast_bodies_;  ///< none before a body may be fast
  int num_fast_ = 0;
  std::optional<FieldOfInterest> field_;   ///< none without the pass
  std::optional<SpaceSleepers> sleepers_;  ///< none without the pass
  std::optional<Breakage> breakage_;       ///< none without the pass
  model::State before_;          ///< state at the start of the step, after its events, for rules that need it
  bool has_before_ = false;      ///< is before_ the current step's?
  std::vector<char> is_broken_;  ///< [joints] as the rules know them; empty: none broken
};

}  // namespace pbmpi::effects
