/// The interface through which a frame is estimated before it is computed (FEEC: fast estimation with error
/// control; Yeh, Faloutsos, Reinman 2006, section 5.2).
#pragma once

#include <cstdint>
#include <span>

#include "core/clock.h"
#include "model/state.h"
#include "stepping/frame.h"

namespace pbmpi::stepping {

/// Makes estimates of the worlds that a rank owns. It starts every frame from the precise state, so that no
/// error lives longer than a frame, and it never changes the precise state.
class Estimator {
 public:
  virtual ~Estimator() = default;

  /// Estimates where `num_steps` steps lead from the precise `worlds` (all that this rank owns now, by
  /// ascending id), which are at the start of step `step`. Adds the seconds spent to `times`.
  virtual void estimate(std::span<const LocalWorld> worlds, std::int64_t step, int num_steps,
                        core::PhaseTimes& times) = 0;

  /// The last estimate() of a world, returned as it is even if it blew up.
  virtual const model::State& state(int world) const = 0;
};

}  // namespace pbmpi::stepping
