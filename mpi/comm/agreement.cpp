#include "mpi/comm/agreement.h"

#include <algorithm>
#include <new>
#include <stdexcept>

#include "core/error.h"

namespace pbmpi::mpi {

void ErrorHold::keep_current() {
  if (failed()) return;
  try {
    throw;
  } catch (const core::InputError& error) {
    kind_ = ErrorKind::input;
    message_ = error.what();
  } catch (const core::RunError& error) {
    kind_ = ErrorKind::run;
    message_ = error.what();
  } catch (const std::bad_alloc&) {
    kind_ = ErrorKind::run;
    message_ = out_of_memory;
  } catch (const std::exception& error) {
    kind_ = ErrorKind::other;
    message_ = error.what();
  } catch (...) {
    kind_ = ErrorKind::other;
    message_ = "an exception of unknown type";
  }
}

void throw_error_of(const Communicator& comm, const ErrorHold& mine, int source, bool everywhere) {
  ErrorKind kind = mine.kind();
  std::string message = mine.message();
  comm.bcast_value(kind, source);
  comm.bcast_string(message, source);
  if (!everywhere) message = "rank " + std::to_string(source) + ": " + message;
  if (kind == ErrorKind::input) throw core::InputError(message);
  if (kind == ErrorKind::run) throw core::RunError(message);
  throw std::runtime_error(message);
}

void agree(const Communicator& comm, const ErrorHold& mine) {
  const std::vector<ErrorKind> kinds = comm.allgather(mine.kind());
  const auto fails = [](ErrorKind kind) { return kind != ErrorKind::none; };
  const auto first = std::find_if(kinds.begin(), kinds.end(), fails);
  if (first == kinds.end()) return;
  const bool everywhere = std::all_of(kinds.begin(), kinds.end(), fails);
  throw_error_of(comm, mine, static_cast<int>(first - kinds.begin()), everywhere);
}

}  // namespace pbmpi::mpi
