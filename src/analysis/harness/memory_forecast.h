/// How much memory the harness needs on any number of ranks.
#pragma once

#include <cstdint>

#include "analysis/harness/harness_costs.h"
#include "analysis/harness/harness_load.h"

namespace pbmpi::analysis {

/// Where results, hashes and times of a run come together at its end.
enum class EndOfRun { on_every_rank, on_root };

/// Bytes; engines are not counted.
struct MemoryForecast {
  double any_rank = 0;  ///< one that is not root and writes no row
  double root = 0;
  double row_writer = 0;  ///< one that has a row of the file's bodies whole (io/hdf5/growing_columns.h)
};

/// `frames`: measured ones, whose phases are joined at the end.
MemoryForecast memory_forecast(const HarnessLoad& load, const HarnessCosts& costs, const GatherShape& shape,
                               EndOfRun end, std::int64_t frames);

}  // namespace pbmpi::analysis
