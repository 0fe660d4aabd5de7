/// Artificial runs for the tests of the page: no engine, but poses with known values.
#pragma once

#include "io/run/run_data.h"

namespace pbmpi::io::html {

struct SampleSize {
  int num_worlds = 4;
  int num_records = 8;  ///< frames, all recorded; the first three are warm-up
  int num_ranks = 2;
  double steps_per_frame = 3, dt_s = 0.01;
};

/// Worlds with a ground plane, a ramp, a car, two humans, a wall and a ball. The car drives along +x at
/// `car_speed` + 0.5 m/s per world; the other bodies stand until the car is at x = 0, and then fall over.
RunData sample_run(const SampleSize& size = {});

inline constexpr double car_start_x_m = -4;
inline constexpr double car_speed_m_s = 20;

}  // namespace pbmpi::io::html
