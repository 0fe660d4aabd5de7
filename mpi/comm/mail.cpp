#include "mpi/comm/mail.h"

#include <exception>
#include <limits>
#include <string>
#include <utility>

#include "core/error.h"
#include "mpi/comm/check.h"

namespace pbmpi::mpi {

struct Mail::Posted {
  MPI_Comm comm = MPI_COMM_NULL;
  std::vector<MPI_Request> requests;
  std::vector<std::vector<std::byte>> messages;
};

Mail::Mail(const Communicator& comm) : comm_(&comm), posted_(std::make_unique<Posted>()) {
  posted_->comm = MPI_Comm_f2c(comm.fortran_handle());
}

// Messages that are still on their way when an error unwinds are abandoned: nobody may be there to receive
// them.
Mail::~Mail() {
  if (std::uncaught_exceptions() == 0) {
    MPI_Waitall(static_cast<int>(posted_->requests.size()), posted_->requests.data(), MPI_STATUSES_IGNORE);
    return;
  }
  for (MPI_Request& request : posted_->requests) {
    if (request != MPI_REQUEST_NULL) MPI_Request_free(&request);
  }
}

void Mail::post(std::vector<std::byte> message, int to, int tag) {
  if (message.size() > static_cast<std::size_t>(std::numeric_limits<int>::max())) {
    throw core::RunError("a message of " + std::to_string(message.size()) +
                         " bytes is longer than MPI can count; cut the world into more spaces");
  }
  ++traffic_.messages;
  traffic_.bytes += static_cast<std::int64_t>(message.size());
  posted_->messages.push_back(std::move(message));
  const std::vector<std::byte>& kept = posted_->messages.back();
  posted_->requests.push_back(MPI_REQUEST_NULL);
  check(MPI_Isend(kept.data(), static_cast<int>(kept.size()), MPI_BYTE, to, tag, posted_->comm,
                  &posted_->requests.back()),
        "MPI_Isend", comm_->rank());
}

std::vector<std::byte> Mail::take(int from, int tag) const {
  MPI_Status status;
  check(MPI_Probe(from, tag, posted_->comm, &status), "MPI_Probe", comm_->rank());
  int size = 0;
  check(MPI_Get_count(&status, MPI_BYTE, &size), "MPI_Get_count", comm_->rank());
  std::vector<std::byte> message(static_cast<std::size_t>(size));
  check(MPI_Recv(message.data(), size, MPI_BYTE, from, tag, posted_->comm, MPI_STATUS_IGNORE), "MPI_Recv",
        comm_->rank());
  return message;
}

bool Mail::has(int from, int tag) const {
  int found = 0;
  check(MPI_Iprobe(from, tag, posted_->comm, &found, MPI_STATUS_IGNORE), "MPI_Iprobe", comm_->rank());
  return found != 0;
}

void Mail::finish() {
  check(
      MPI_Waitall(static_cast<int>(posted_->requests.size()), posted_->requests.data(), MPI_STATUSES_IGNORE),
      "MPI_Waitall", comm_->rank());
  posted_->requests.clear();
  posted_->messages.clear();
}

core::Traffic Mail::take_traffic() { return std::exchange(traffic_, {}); }

}  // namespace pbmpi::mpi
