#include "mpi/comm/shared_counter.h"

#include <exception>

#include "mpi/comm/check.h"

namespace pbmpi::mpi {

struct SharedCounter::Window {
  MPI_Win window = MPI_WIN_NULL;
  int rank = 0;
  int unwinding = std::uncaught_exceptions();
};

SharedCounter::SharedCounter(const Communicator& comm) {
  if (comm.size() == 1) return;
  window_ = std::make_unique<Window>();
  window_->rank = comm.rank();
  const MPI_Aint bytes = comm.is_root() ? sizeof(std::int64_t) : 0;
  std::int64_t* number = nullptr;
  check(MPI_Win_allocate(bytes, sizeof(std::int64_t), MPI_INFO_NULL, MPI_Comm_f2c(comm.fortran_handle()),
                         static_cast<void*>(&number), &window_->window),
        "MPI_Win_allocate", comm.rank());
  check(MPI_Win_set_errhandler(window_->window, MPI_ERRORS_RETURN), "MPI_Win_set_errhandler", comm.rank());
  if (comm.is_root()) {
    check(MPI_Win_lock(MPI_LOCK_EXCLUSIVE, Communicator::root, 0, window_->window), "MPI_Win_lock",
          comm.rank());
    *number = 0;
    check(MPI_Win_unlock(Communicator::root, window_->window), "MPI_Win_unlock", comm.rank());
  }
  comm.barrier();
}

SharedCounter::~SharedCounter() {
  if (window_ && std::uncaught_exceptions() == window_->unwinding) MPI_Win_free(&window_->window);
}

std::int64_t SharedCounter::add(std::int64_t number) {
  if (!window_) return (alone_ += number) - number;
  std::int64_t before = 0;
  const int rank = window_->rank;
  check(MPI_Win_lock(MPI_LOCK_SHARED, Communicator::root, 0, window_->window), "MPI_Win_lock", rank);
  check(MPI_Fetch_and_op(&number, &before, MPI_INT64_T, Communicator::root, 0, MPI_SUM, window_->window),
        "MPI_Fetch_and_op", rank);
  check(MPI_Win_unlock(Communicator::root, window_->window), "MPI_Win_unlock", rank);
  return before;
}

}  // namespace pbmpi::mpi
