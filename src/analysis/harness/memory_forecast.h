/// Forecasts the memory of the harness on any number of ranks.
#pragma once

#include <cstdint>

#include "analysis/harness/harness_costs.h"
#include "analysis/harness/harness_load.h"

namespace pbmpi::analysis {

/// Where results, hashes and times of a run are joined at its end.
enum class EndOfRun { on_every_rank, on_root };

/// Bytes; engines are not counted.
struct MemoryForecast {
  double any_rank = 0;  ///< a rank that is not root and writes no row
  double root = 0;
  double row_writer = 0;  ///< a rank that holds a whole row of the file's bodies (io/hdf5/growing_columns.h)
};

/// `frames`: number of measured frames, whose phases are joined at the end.
MemoryForecast memory_forecast(const HarnessLoad& load, const HarnessCosts& costs, const GatherShape& shape,
                               EndOfRun end, std::int64_t frames);

}  // namespace pbmpi::analysis
