#include "analysis/harness/memory_forecast.h"

#include <algorithm>

#include "analysis/harness/frame_traffic.h"
#include "core/clock.h"

namespace pbmpi::analysis {
namespace {

// Bytes per world on every rank: its owner; where its bodies begin, in the driver, in the file's setup and in
// its columns; and where its joints begin.
constexpr double table_bytes = 4 + 3 * 8 + 8;
// Bytes per world on root: its owner and cost, three frames' costs and their median, and the rebalancer's
// lists.
constexpr double balance_bytes = 4 + 8 + 3 * 8 + 8 + 12;
// Bytes of a world's results at the end of a run: as collected, joined, and written.
constexpr double result_bytes = 104 + 104 + 160;
// Bytes of a body's position, orientation and both velocities.
constexpr double motion_bytes = 13 * 8;
// Bytes of a rank's phases in a frame.
constexpr double phase_bytes = core::num_phases * 8;

}  // namespace

MemoryForecast memory_forecast(const HarnessLoad& load, const HarnessCosts& costs, const GatherShape& shape,
                               EndOfRun end, std::int64_t frames) {
  const double all_worlds = static_cast<double>(load.num_worlds);
  const double all_bodies = all_worlds * static_cast<double>(load.bodies_each);
  const double own_worlds = static_cast<double>(load.worlds_of(0));
  const double own_bodies = own_worlds * static_cast<double>(load.bodies_each);
  const double at_end =
      all_worlds * result_bytes + static_cast<double>(frames) * load.num_ranks * phase_bytes;
  const double pieces = 2.0 * static_cast<double>(std::min(
                                  shape.piece_bytes, bytes_of_world(load.bodies_each) * load.num_worlds));
  const bool hands_on = load.num_ranks > shape.radix;

  MemoryForecast memory;
  memory.any_rank = costs.base_bytes + all_worlds * table_bytes + own_bodies * costs.body_bytes +
                    own_worlds * static_cast<double>(bytes_of_world(load.bodies_each)) +
                    (hands_on ? pieces : 0) + own_worlds * result_bytes;
  const double gathered = 2 * all_worlds * static_cast<double>(bytes_of_world(load.bodies_each));
  memory.root = memory.any_rank + gathered + all_worlds * balance_bytes + at_end;
  if (end == EndOfRun::on_every_rank) memory.any_rank += at_end;
  memory.row_writer = memory.any_rank + all_bodies * motion_bytes;
  return memory;
}

}  // namespace pbmpi::analysis
