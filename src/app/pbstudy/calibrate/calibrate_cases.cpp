#include "app/pbstudy/calibrate/calibrate_cases.h"

#include <algorithm>
#include <numeric>

#include "core/random.h"

namespace pbmpi::app {

std::vector<TimedCase> make_calibrate_cases(int num_ranks, int largest_ranks) {
  std::vector<TimedCase> cases;
  const auto add_frames = [&](std::int64_t ranks) {
    for (const std::int64_t worlds : {4, 64, 1024}) {
      for (const std::int64_t bodies : {1, 37}) {
        for (const std::int64_t steps : {1, 6})
          cases.push_back({TimedPart::frame, ranks, worlds, bodies, steps, 0, 0});
      }
    }
  };
  add_frames(1);
  for (std::int64_t ranks = 64; ranks <= largest_ranks; ranks *= ranks < 16384 ? 16 : 8) {
    for (const std::int64_t each : {1, 4}) {
      const std::int64_t worlds = ranks * each;
      for (const std::int64_t bodies : {1, 37})
        cases.push_back({TimedPart::unpack, ranks, worlds, bodies, 0, 0, 0});
      for (const TimedPart part : {TimedPart::balance, TimedPart::move, TimedPart::table, TimedPart::hash})
        cases.push_back({part, ranks, worlds, 0, 0, 0, 0});
    }
  }
  cases.push_back({TimedPart::bodies, 1, 256, 37, 0, 0, 0});
  if (num_ranks == 1) return cases;
  add_frames(num_ranks);
  for (const std::int64_t bytes : {8, 4096, 65536, 1048576})
    cases.push_back({TimedPart::message, 2, 0, 0, 0, bytes, 0});
  cases.push_back({TimedPart::send, 2, 0, 0, 0, 8, 0});
  cases.push_back({TimedPart::receive, 2, 0, 0, 0, 8, 0});
  return cases;
}

bool is_collective(const TimedCase& one) {
  const bool is_message =
      one.part == TimedPart::message || one.part == TimedPart::send || one.part == TimedPart::receive;
  return is_message || (one.part == TimedPart::frame && one.ranks > 1);
}

std::vector<std::size_t> order_of_round(std::size_t num_cases, std::uint64_t seed, int round) {
  std::vector<std::size_t> order(num_cases);
  std::iota(order.begin(), order.end(), std::size_t{0});
  const auto key = [&](std::size_t i) { return core::mix_key(seed, static_cast<std::uint64_t>(round), i); };
  std::ranges::sort(order, {}, key);
  return order;
}

}  // namespace pbmpi::app
