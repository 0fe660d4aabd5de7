#include "mpi/frame/checkpoint_schedule.h"

namespace pbmpi::mpi {

bool CheckpointSchedule::due(Then then, std::int64_t requests, double now_s) {
  const bool asked = requests > answered_;
  answered_ = requests;
  const bool now = asked || now_s - last_s_ >= plan_.every_s || (then == Then::stop && plan_.at_stop) ||
                   (then == Then::end && plan_.at_end);
  if (now) last_s_ = now_s;
  return now;
}

}  // namespace pbmpi::mpi
