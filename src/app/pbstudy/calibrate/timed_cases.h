/// How a case of "pbstudy calibrate" is timed, once.
#pragma once

#include "app/pbstudy/calibrate/calibrate_cases.h"
#include "mpi/comm/communicator.h"

namespace pbmpi::app {

/// Seconds of a frame of worlds without physics; the shortest of a few. Collective over `comm`, which is the
/// null communicator for frames of one rank.
double time_frame(const mpi::Communicator& comm, const TimedCase& one);

/// Seconds of root's work for one.ranks ranks, none of which is there. Not collective.
double time_root(const TimedCase& one);

/// Seconds of a message between ranks 0 and 1; collective over the two. Measured at the rank that the part
/// names.
double time_message(const mpi::Communicator& comm, const TimedCase& one);

}  // namespace pbmpi::app
