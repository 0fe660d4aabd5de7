#include "core/clock.h"

#include <gtest/gtest.h>

#include <chrono>
#include <thread>

namespace pbmpi::core {
namespace {

TEST(Clock, never_goes_back) {
  double last = now_s();
  for (int i = 0; i < 1000; ++i) {
    const double now = now_s();
    ASSERT_GE(now, last);
    last = now;
  }
}

TEST(ThreadCpu, counts_work_and_not_sleep) {
  const double start_s = thread_cpu_s();
  std::this_thread::sleep_for(std::chrono::milliseconds(200));
  const double slept_s = thread_cpu_s() - start_s;
  EXPECT_GE(slept_s, 0);
  EXPECT_LT(slept_s, 0.1) << "half of what passed, to be out of all doubt";
  while (thread_cpu_s() - start_s < slept_s + 1e-4) {  // ends only if work counts
  }
}

TEST(PhaseTimes, counts_as_useful_what_comes_before_ship) {
  PhaseTimes times;
  for (int phase = 0; phase < num_phases; ++phase) times.seconds[phase] = 1 << phase;
  EXPECT_EQ(times[Phase::ship], 64);
  EXPECT_EQ(times.useful_s(), 1 + 2 + 4 + 8 + 16 + 32);
}

TEST(LapTimer, shares_all_time_out_to_the_phases) {
  PhaseTimes times;
  const double start = now_s();
  LapTimer timer(times);
  timer.lap(Phase::collide);
  const double between = now_s();
  timer.lap(Phase::solve);
  const double end = now_s();
  const double sum = times[Phase::collide] + times[Phase::solve];
  EXPECT_LE(sum, end - start);
  EXPECT_GE(sum, 0);
  EXPECT_LE(times[Phase::collide], between - start);
  EXPECT_EQ(times[Phase::output], 0);
}

}  // namespace
}  // namespace pbmpi::core
