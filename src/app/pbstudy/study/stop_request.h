/// What asks a study to stop after the cases at hand.
#pragma once

namespace pbmpi::app {

/// While one lives, USR2 is noted: what a job script sends to mpirun when the time is up, which passes it to
/// all ranks. One at a time. INT and TERM end the process at once; what its cases have given so far is in the
/// journal.
class StopRequest {
 public:
  StopRequest();
  ~StopRequest();
  StopRequest(const StopRequest&) = delete;
  StopRequest& operator=(const StopRequest&) = delete;

  bool is_set() const;
};

}  // namespace pbmpi::app
