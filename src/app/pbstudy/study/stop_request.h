/// Notes requests to stop a study after its current cases.
#pragma once

namespace pbmpi::app {

/// While an object of this class lives, USR2 is noted: a job script sends it to mpirun when the time is up,
/// and mpirun passes it to all ranks. At most one object at a time. INT and TERM end the process at once; the
/// outcomes so far are in the journal.
class StopRequest {
 public:
  StopRequest();
  ~StopRequest();
  StopRequest(const StopRequest&) = delete;
  StopRequest& operator=(const StopRequest&) = delete;

  bool is_set() const;
};

}  // namespace pbmpi::app
