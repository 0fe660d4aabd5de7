/// The effects that a world can have, and which of them a model calls for.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/clock.h"
#include "model/model.h"

namespace pbmpi::model {

/// One effect of the registry.
struct Effect {
  std::string_view name;     ///< as in --effects and in scene files
  std::string_view meaning;  ///< one line
  core::Phase phase;         ///< the phase of the step that its pass joins
  /// Why the model calls for it ("212 geoms with mu > 0"), or nothing if it does not.
  std::optional<std::string> (*reason)(const Model& model);
};

/// All effects, in the order of the step.
const std::vector<Effect>& effect_registry();

/// A pass of the step: an effect that the model calls for.
struct Pass {
  const Effect* effect = nullptr;
  std::string reason;
};

/// The passes of a world's step, in order. An effect that nothing calls for has none.
class StepPlan {
 public:
  explicit StepPlan(const Model& model);
  bool has(std::string_view effect) const;
  const std::vector<Pass>& passes() const { return passes_; }

 private:
  std::vector<Pass> passes_;
};

}  // namespace pbmpi::model
