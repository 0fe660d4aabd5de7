#include "mpi/comm/processor_time.h"

#include <time.h>

#include "core/clock.h"

namespace pbmpi::mpi {
namespace {

double waiting_s = 0;  ///< processor time of the waits that have ended
int depth = 0;         ///< of Waiting within Waiting

}  // namespace

double processor_time_s() {
  timespec time{};
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &time);
  return static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec) - waiting_s;
}

Waiting::Waiting() {
  if (depth++ == 0) start_s_ = core::thread_cpu_s();
}

Waiting::~Waiting() {
  if (--depth == 0) waiting_s += core::thread_cpu_s() - start_s_;
}

}  // namespace pbmpi::mpi
