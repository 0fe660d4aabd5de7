#include "mpi/comm/pending_messages.h"

#include <algorithm>
#include <exception>
#include <limits>
#include <string>
#include <utility>
#include <vector>

#include "core/error.h"
#include "mpi/comm/check.h"
#include "mpi/comm/processor_time.h"

namespace pbmpi::mpi {

struct PendingMessages::Requests {
  MPI_Comm comm = MPI_COMM_NULL;
  std::vector<MPI_Request> open;
};

namespace {

/// Below the shortest eager limit of Open MPI's transports (4 KiB with header, shared memory).
constexpr std::size_t piece_doubles = 448;

template <class Double, class Call>
void in_pieces(std::span<Double> values, Call&& call) {
  for (; !values.empty(); values = values.subspan(std::min(values.size(), piece_doubles))) {
    call(values.first(std::min(values.size(), piece_doubles)));
  }
}

}  // namespace

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
    const Waiting waiting;
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
  {
    const Waiting waiting;
    check(MPI_Probe(from, tag, posted_->comm, &status), "MPI_Probe", comm_->rank());
  }
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
  const Waiting waiting;
  check(
      MPI_Waitall(static_cast<int>(posted_->requests.size()), posted_->requests.data(), MPI_STATUSES_IGNORE),
      "MPI_Waitall", comm_->rank());
  posted_->requests.clear();
  posted_->messages.clear();
}

core::Traffic Mail::take_traffic() { return std::exchange(traffic_, {}); }

PendingMessages::PendingMessages(const Communicator& comm)
    : comm_(&comm), requests_(std::make_unique<Requests>()) {
  if (!comm.is_null()) requests_->comm = MPI_Comm_f2c(comm.fortran_handle());
}

PendingMessages::~PendingMessages() {
  for (MPI_Request& request : requests_->open) {
    MPI_Cancel(&request);
    MPI_Request_free(&request);
  }
}

void PendingMessages::send(std::span<const double> values, int to, int tag) {
  core::require_invariant(!comm_->is_null(), "send: the null communicator has no other rank");
  in_pieces(values, [&](std::span<const double> piece) {
    MPI_Request request = MPI_REQUEST_NULL;
    check(MPI_Isend(piece.data(), static_cast<int>(piece.size()), MPI_DOUBLE, to, tag, requests_->comm,
                    &request),
          "MPI_Isend", comm_->rank());
    requests_->open.push_back(request);
  });
}

void PendingMessages::receive(std::span<double> values, int from, int tag) {
  core::require_invariant(!comm_->is_null(), "receive: the null communicator has no other rank");
  in_pieces(values, [&](std::span<double> piece) {
    MPI_Request request = MPI_REQUEST_NULL;
    check(MPI_Irecv(piece.data(), static_cast<int>(piece.size()), MPI_DOUBLE, from, tag, requests_->comm,
                    &request),
          "MPI_Irecv", comm_->rank());
    requests_->open.push_back(request);
  });
}

void PendingMessages::wait() {
  auto& open = requests_->open;
  if (open.empty()) return;
  const Waiting waiting;
  const int code = MPI_Waitall(static_cast<int>(open.size()), open.data(), MPI_STATUSES_IGNORE);
  std::erase(open, MPI_REQUEST_NULL);
  check(code, "MPI_Waitall", comm_->rank());
  open.clear();
}

}  // namespace pbmpi::mpi
