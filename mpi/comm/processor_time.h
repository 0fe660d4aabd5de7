/// Processor time of a rank without what it uses to wait for others: MPI polls, so that a rank that waits
/// keeps its core busy.
#pragma once

namespace pbmpi::mpi {

/// Seconds of processor time that this rank has used so far, by all its threads, except while Waiting. Unlike
/// seconds of a clock they hardly depend on how many ranks share a core.
double processor_time_s();

/// The time of its life counts as waiting for other ranks: for a call of MPI that may wait, or a loop that
/// polls. Of the thread that calls MPI; one within another changes nothing.
class Waiting {
 public:
  Waiting();
  ~Waiting();
  Waiting(const Waiting&) = delete;
  Waiting& operator=(const Waiting&) = delete;

 private:
  double start_s_ = 0;
};

}  // namespace pbmpi::mpi
