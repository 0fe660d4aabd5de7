#include "mpi/comm/pending_messages.h"

#include <algorithm>
#include <vector>

#include "core/error.h"
#include "mpi/comm/check.h"

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
  const int code = MPI_Waitall(static_cast<int>(open.size()), open.data(), MPI_STATUSES_IGNORE);
  std::erase(open, MPI_REQUEST_NULL);
  check(code, "MPI_Waitall", comm_->rank());
  open.clear();
}

}  // namespace pbmpi::mpi
