/// The cases that "pbstudy calibrate" times, and their order.
#pragma once

#include <cstdint>
#include <vector>

#include "app/pbstudy/calibrate/timed_case.h"

namespace pbmpi::app {

/// Cases without seconds; `num_ranks`: the ranks available. Those of one rank come first, then those in which
/// all ranks take part: frames of all of them, and messages.
std::vector<TimedCase> make_calibrate_cases(int num_ranks, int largest_ranks);

/// Does a case need other ranks?
bool is_collective(const TimedCase& one);

/// The cases 0 to `num_cases` - 1 in the random order of a round.
std::vector<std::size_t> order_of_round(std::size_t num_cases, std::uint64_t seed, int round);

}  // namespace pbmpi::app
