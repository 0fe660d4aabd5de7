#include "mpi/comm/processor_time.h"

#include <gtest/gtest.h>

#include "core/clock.h"

namespace pbmpi::mpi {
namespace {

constexpr double work_s = 0.02;

/// Keeps the core busy until this thread has used that much of it.
void compute() {
  const double until_s = core::thread_cpu_s() + work_s;
  while (core::thread_cpu_s() < until_s) {
  }
}

TEST(ProcessorTime, grows_by_what_is_computed) {
  const double start_s = processor_time_s();
  compute();
  EXPECT_GE(processor_time_s() - start_s, 0.99 * work_s);
}

TEST(ProcessorTime, stands_still_in_waits_and_waits_within_them) {
  const double start_s = processor_time_s();
  {
    const Waiting waiting;
    {
      const Waiting within;
      compute();
    }
    compute();
  }
  EXPECT_LT(processor_time_s() - start_s, 0.5 * work_s);
}

}  // namespace
}  // namespace pbmpi::mpi
