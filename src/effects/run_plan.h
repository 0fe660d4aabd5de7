/// The step plans of all worlds of a run, as one.
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "effects/effects.h"

namespace pbmpi::effects {

/// What the worlds of a run say of one effect.
struct PassTally {
  int worlds = 0;       ///< worlds that have its pass
  int idle_worlds = 0;  ///< of these, worlds that demand it though nothing in them calls for it
  /// Reason::what -> the sum of Reason::count over the worlds that call for it.
  std::map<std::string, std::int64_t> counts;
};

/// A pass that some world of a run has.
struct RunPass {
  const Effect* effect = nullptr;
  std::string reason;  ///< "3900 geoms with mu > 0, in 100 worlds"; for a single world as in its StepPlan
  bool idle = false;   ///< demanded, though nothing in any world calls for it
};

/// Added up world by world, in any order and in parts.
struct RunPlan {
  int num_worlds = 0;
  std::vector<PassTally> tallies = std::vector<PassTally>(effect_registry().size());  ///< [effects]

  void add(const model::Model& world);
  void add(const RunPlan& other);
  /// In the order of the registry.
  std::vector<RunPass> passes() const;
};

}  // namespace pbmpi::effects
