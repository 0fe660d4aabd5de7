/// The effects that a world can have, and which of them a model calls for.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "core/clock.h"
#include "model/model.h"
#include "model/state.h"

namespace pbmpi::effects {

/// Why a model calls for an effect.
struct Reason {
  std::int64_t count = 0;  ///< how many things call for it; 0 where nothing is counted
  std::string what;        ///< what is counted ("geoms with mu > 0"), or the whole reason
  std::string text() const { return count == 0 ? what : std::to_string(count) + " " + what; }
};

/// Names an effect in code; texts for people (scene files, --effects, reports) use Effect::name.
enum class EffectId {
  events,
  steering,
  drag,
  collision,
  cross_space,
  fast_bodies,
  field_of_interest,
  friction,
  restitution,
  joints,
  limits,
  motors,
  suspension,
  breakable_joints,
  gyroscopic_torque,
  gravity,
  damping,
  sleeping,
};

/// Changes the velocities of some bodies at the start of a step of `dt_s`, after the step's events and before
/// collision detection: the rows of `state` that belong to `bodies`. A body's new velocity must depend on
/// nothing but its own row, and must not be faster, since ranks that share a world learn of its fast bodies
/// at the end of the previous step. A velocity of zero stays zero.
using VelocityRule = std::function<void(double dt_s, std::span<const int> bodies, model::State& state)>;

/// One effect of the registry.
struct Effect {
  EffectId id;
  std::string_view name;     ///< as in --effects and in scene files
  std::string_view meaning;  ///< one line
  core::Phase phase;         ///< the phase of the step that its pass joins
  /// Why the model calls for it ("212 geoms with mu > 0"), or nothing if it does not.
  std::optional<Reason> (*reason)(const model::Model& model);
  /// Removes from the model what calls for it; does nothing where only its pass is left out. Throws
  /// core::InputError if the model falls apart without it.
  void (*leave_out)(model::Model& model);
  /// For an effect that changes velocities: this model's rule, for StepRules.
  VelocityRule (*make_velocity_rule)(const model::Model& model) = nullptr;
};

/// All effects, in the order of the step, which is the order of EffectId; indexed by EffectId.
const std::vector<Effect>& effect_registry();

/// True: the model demands the effect; false: it leaves it out; nothing: the rest of the model decides.
std::optional<bool> choice_of(const model::Model& model, EffectId effect);
inline bool is_left_out(const model::Model& model, EffectId effect) {
  return choice_of(model, effect) == std::optional<bool>(false);
}

/// A pass of the step: an effect that the model calls for.
struct Pass {
  const Effect* effect = nullptr;
  Reason reason;
  bool idle = false;  ///< demanded, though nothing calls for it
};

/// False for a body whose inertia is the same about every axis, like a sphere's or a cube's: its gyroscopic
/// torque is exactly zero.
bool has_gyroscopic_torque(const model::Body& body);

/// The passes of a world's step, in order. An effect that nothing calls for has no pass unless it is
/// demanded; an effect that is left out has none. A pass that nothing calls for changes no bit of a state.
class StepPlan {
 public:
  explicit StepPlan(const model::Model& model);
  bool has(EffectId effect) const { return find(effect) != nullptr; }
  /// Is the pass there only because it is demanded?
  bool is_idle(EffectId effect) const;
  const std::vector<Pass>& passes() const { return passes_; }

 private:
  const Pass* find(EffectId effect) const;

  std::vector<Pass> passes_;
};

}  // namespace pbmpi::effects
