/// Positions of an ensemble's bodies.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "app/pbreport/ensemble/ensemble_runs.h"
#include "app/pbreport/ensemble/spread.h"
#include "core/vector.h"

namespace pbmpi::app {

/// A body in a recorded frame. A sample is the body's position in a run (or in a world of it); its distance
/// is measured from the mean of the finite samples.
struct BodySpread {
  core::Vec3 mean;   ///< [m]; NaN without a finite sample
  double rms_m = 0;  ///< of the distances
  Spread distance;   ///< [m]
};

/// All bodies in a recorded frame.
struct PositionSpread {
  std::size_t frame = 0;           ///< index in the runs' frames
  double rms_m = 0;                ///< over the distances of all samples of all bodies
  Spread of_bodies;                ///< [m] of the bodies' rms
  std::int64_t widest = -1;        ///< the body with the largest rms; -1: none is finite
  std::vector<BodySpread> bodies;  ///< [bodies of a sample]; only if they are kept
};

/// A body over the measured frames.
struct BodySummary {
  double rms_m = 0, max_m = 0;  ///< over its distances
  std::int64_t nonfinite = 0;   ///< samples
  BodySpread last;              ///< in the last recorded frame
};

struct EnsemblePositions {
  std::vector<PositionSpread> frames;  ///< [num_recorded]
  std::vector<BodySummary> bodies;     ///< [bodies of a sample]
};

EnsemblePositions spread_of_positions(const EnsembleRuns& ensemble, const std::vector<double>& quantiles,
                                      bool keep_bodies);

}  // namespace pbmpi::app
