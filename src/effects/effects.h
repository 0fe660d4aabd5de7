/// The effects that a world can have, and which of them a model calls for.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/clock.h"
#include "model/model.h"

namespace pbmpi::effects {

/// Why a model calls for an effect.
struct Reason {
  std::int64_t count = 0;  ///< of what calls for it; 0 where nothing is counted
  std::string what;        ///< what is counted ("geoms with mu > 0"), or all there is to say
  std::string text() const { return count == 0 ? what : std::to_string(count) + " " + what; }
};

/// One effect of the registry.
struct Effect {
  std::string_view name;     ///< as in --effects and in scene files
  std::string_view meaning;  ///< one line
  core::Phase phase;         ///< the phase of the step that its pass joins
  /// Why the model calls for it ("212 geoms with mu > 0"), or nothing if it does not.
  std::optional<Reason> (*reason)(const model::Model& model);
  /// Takes out of the model what calls for it; does nothing where only its pass is left out. Throws
  /// core::InputError if the model falls apart without.
  void (*leave_out)(model::Model& model);
};

/// All effects, in the order of the step.
const std::vector<Effect>& effect_registry();

/// A pass of the step: an effect that the model calls for.
struct Pass {
  const Effect* effect = nullptr;
  Reason reason;
  bool idle = false;  ///< demanded, though nothing calls for it
};

/// False for a body whose inertia is the same about every axis, like a sphere's or a cube's: its torque is
/// exactly zero.
bool has_gyroscopic_torque(const model::Body& body);

/// The passes of a world's step, in order. An effect that nothing calls for has none, unless it is demanded;
/// one that is left out has none. A pass that nothing calls for changes no bit of a state.
class StepPlan {
 public:
  explicit StepPlan(const model::Model& model);
  bool has(std::string_view effect) const { return find(effect) != nullptr; }
  /// Is the pass there only because it is demanded?
  bool is_idle(std::string_view effect) const;
  const std::vector<Pass>& passes() const { return passes_; }

 private:
  const Pass* find(std::string_view effect) const;

  std::vector<Pass> passes_;
};

}  // namespace pbmpi::effects
