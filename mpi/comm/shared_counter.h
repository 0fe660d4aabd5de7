/// A number that all ranks count up, each when it likes.
#pragma once

#include <cstdint>
#include <memory>

#include "mpi/comm/communicator.h"

namespace pbmpi::mpi {

/// Hands out 0, 1, 2, ... to whichever rank asks next, without any other rank taking part in the call: for
/// work that is dealt out piece by piece. Lies in root's memory. Constructor and destructor are collective;
/// the destructor leaves the memory to the program's end while an exception unwinds. With one rank or none
/// MPI is not called. Throws core::RunError like Communicator.
class SharedCounter {
 public:
  explicit SharedCounter(const Communicator& comm);
  ~SharedCounter();
  SharedCounter(const SharedCounter&) = delete;
  SharedCounter& operator=(const SharedCounter&) = delete;

  /// Not collective.
  std::int64_t next() { return add(1); }
  /// Leaves out the next `count` numbers. Not collective.
  void skip(std::int64_t count) { add(count); }
  /// How many were handed out or left out. Not collective.
  std::int64_t value() { return add(0); }

 private:
  std::int64_t add(std::int64_t number);

  struct Window;
  std::unique_ptr<Window> window_;  ///< null with one rank
  std::int64_t alone_ = 0;
};

}  // namespace pbmpi::mpi
