#include "mpi/comm/communicator.h"

#include <unistd.h>

#include <array>
#include <cstring>
#include <exception>
#include <limits>
#include <utility>

#include "core/error.h"
#include "mpi/comm/check.h"
#include "mpi/comm/processor_time.h"

namespace pbmpi::mpi {

struct Communicator::Handle {
  MPI_Comm comm;
  bool owned;
  int rank = 0;
  int size = 1;

  Handle(MPI_Comm of, bool is_owned) : comm(of), owned(is_owned) {
    check(MPI_Comm_rank(comm, &rank), "MPI_Comm_rank");
    check(MPI_Comm_size(comm, &size), "MPI_Comm_size", rank);
  }
  // MPI_Comm_free is collective: it could wait for ever while only this rank unwinds, so it is skipped then.
  // It is also skipped once MPI has been finalised, which can happen when another library gave us the
  // communicator.
  ~Handle() {
    int ended = 0;
    if (owned && std::uncaught_exceptions() == 0 && MPI_Finalized(&ended) == MPI_SUCCESS && ended == 0)
      MPI_Comm_free(&comm);
  }
  Handle(const Handle&) = delete;
  Handle& operator=(const Handle&) = delete;
};

namespace {

int to_count(std::int64_t count) {
  if (count > std::numeric_limits<int>::max()) {
    throw core::RunError("a message of " + std::to_string(count) +
                         " elements is longer than MPI can count; use more ranks or fewer worlds");
  }
  return static_cast<int>(count);
}

/// The MPI type of one element. Uses words of 8 bytes where they fit, since MPI counts in int: 16 GiB a
/// message.
class ElementType {
 public:
  ElementType(std::size_t element_size, int rank) {
    const bool words = element_size % sizeof(std::uint64_t) == 0;
    basic_ = words ? MPI_UINT64_T : MPI_BYTE;
    const auto length = static_cast<int>(words ? element_size / sizeof(std::uint64_t) : element_size);
    type_ = basic_;
    if (length == 1) return;
    check(MPI_Type_contiguous(length, basic_, &type_), "MPI_Type_contiguous", rank);
    check(MPI_Type_commit(&type_), "MPI_Type_commit", rank);
  }
  ~ElementType() {
    if (type_ != basic_) MPI_Type_free(&type_);
  }
  ElementType(const ElementType&) = delete;
  ElementType& operator=(const ElementType&) = delete;
  operator MPI_Datatype() const { return type_; }

 private:
  MPI_Datatype basic_;
  MPI_Datatype type_;
};

MPI_Op to_op(Reduce op) {
  switch (op) {
    case Reduce::sum:
      return MPI_SUM;
    case Reduce::min:
      return MPI_MIN;
    case Reduce::max:
      return MPI_MAX;
  }
  throw std::logic_error("Reduce: not an enumerator");
}

void copy_bytes(void* to, const void* from, std::size_t bytes) {
  if (bytes > 0) std::memcpy(to, from, bytes);
}

}  // namespace

GatherLayout GatherLayout::packed(std::span<const std::int64_t> counts) {
  GatherLayout layout;
  std::int64_t end = 0;
  for (const std::int64_t count : counts) {
    layout.displacements.push_back(to_count(end));
    layout.counts.push_back(to_count(count));
    end += count;
  }
  to_count(end);
  return layout;
}

Communicator::Communicator() = default;
Communicator::Communicator(std::unique_ptr<Handle> handle) : handle_(std::move(handle)) {}
Communicator::~Communicator() = default;
Communicator::Communicator(Communicator&&) noexcept = default;
Communicator& Communicator::operator=(Communicator&&) noexcept = default;

Communicator Communicator::world() { return Communicator(std::make_unique<Handle>(MPI_COMM_WORLD, false)); }

Communicator Communicator::dup_of(int fortran_handle) {
  int runs = 0, ended = 0;
  check(MPI_Initialized(&runs), "MPI_Initialized");
  check(MPI_Finalized(&ended), "MPI_Finalized");
  core::require_input(runs != 0 && ended == 0,
                      "a communicator was given, and MPI does not run; call MPI_Init before, or give none");
  const MPI_Comm theirs = MPI_Comm_f2c(fortran_handle);
  core::require_input(theirs != MPI_COMM_NULL,
                      "the communicator that was given is MPI_COMM_NULL; give one that "
                      "has this rank, or none");
  MPI_Comm copy = MPI_COMM_NULL;
  check(MPI_Comm_dup(theirs, &copy), "MPI_Comm_dup");
  check(MPI_Comm_set_errhandler(copy, MPI_ERRORS_RETURN), "MPI_Comm_set_errhandler");
  return Communicator(std::make_unique<Handle>(copy, true));
}

Communicator Communicator::dup() const {
  if (is_null()) return {};
  MPI_Comm copy = MPI_COMM_NULL;
  check(MPI_Comm_dup(handle_->comm, &copy), "MPI_Comm_dup", rank());
  return Communicator(std::make_unique<Handle>(copy, true));
}

Communicator Communicator::split(int group) const {
  if (is_null()) return {};
  MPI_Comm part = MPI_COMM_NULL;
  check(MPI_Comm_split(handle_->comm, group, rank(), &part), "MPI_Comm_split", rank());
  check(MPI_Comm_set_errhandler(part, MPI_ERRORS_RETURN), "MPI_Comm_set_errhandler", rank());
  return Communicator(std::make_unique<Handle>(part, true));
}

int Communicator::rank() const { return is_null() ? 0 : handle_->rank; }
int Communicator::size() const { return is_null() ? 1 : handle_->size; }
int Communicator::fortran_handle() const { return MPI_Comm_c2f(is_null() ? MPI_COMM_NULL : handle_->comm); }

void Communicator::barrier() const {
  if (is_null()) return;
  const Waiting waiting;
  check(MPI_Barrier(handle_->comm), "MPI_Barrier", rank());
}

void Communicator::bcast_string(std::string& text, int from) const {
  auto length = static_cast<std::int64_t>(text.size());
  bcast_value(length, from);
  text.resize(static_cast<std::size_t>(length));
  bcast(std::span<char>(text), from);
}

void Communicator::bcast_bytes(void* data, std::size_t count, std::size_t element_size, int from) const {
  if (is_null()) return;
  const ElementType type(element_size, rank());
  const Waiting waiting;
  check(MPI_Bcast(data, to_count(static_cast<std::int64_t>(count)), type, from, handle_->comm), "MPI_Bcast",
        rank());
}

void Communicator::allgather_bytes(const void* mine, void* all, std::size_t element_size) const {
  if (is_null()) return copy_bytes(all, mine, element_size);
  const ElementType type(element_size, rank());
  const Waiting waiting;
  check(MPI_Allgather(mine, 1, type, all, 1, type, handle_->comm), "MPI_Allgather", rank());
}

void Communicator::allgatherv_bytes(const void* mine, std::size_t count, void* all,
                                    const GatherLayout& layout, std::size_t element_size) const {
  if (is_null()) return copy_bytes(all, mine, count * element_size);
  const ElementType type(element_size, rank());
  const Waiting waiting;
  check(MPI_Allgatherv(mine, to_count(static_cast<std::int64_t>(count)), type, all, layout.counts.data(),
                       layout.displacements.data(), type, handle_->comm),
        "MPI_Allgatherv", rank());
}

void Communicator::send_bytes(const void* data, std::size_t count, std::size_t element_size, int to,
                              int tag) const {
  core::require_invariant(!is_null(), "send: the null communicator has no other rank");
  const ElementType type(element_size, rank());
  const Waiting waiting;
  check(MPI_Send(data, to_count(static_cast<std::int64_t>(count)), type, to, tag, handle_->comm), "MPI_Send",
        rank());
}

void Communicator::recv_bytes(void* data, std::size_t count, std::size_t element_size, int from,
                              int tag) const {
  core::require_invariant(!is_null(), "recv: the null communicator has no other rank");
  const ElementType type(element_size, rank());
  MPI_Status status;
  const Waiting waiting;
  check(MPI_Recv(data, to_count(static_cast<std::int64_t>(count)), type, from, tag, handle_->comm, &status),
        "MPI_Recv", rank());
  int received = 0;
  check(MPI_Get_count(&status, type, &received), "MPI_Get_count", rank());
  if (!std::cmp_equal(received, count)) {
    throw core::RunError("MPI_Recv on rank " + std::to_string(rank()) + ": " + std::to_string(received) +
                         " elements came from rank " + std::to_string(from) + " where " +
                         std::to_string(count) + " were expected");
  }
}

void Communicator::allreduce(std::span<double> values, Reduce op) const {
  if (is_null()) return;
  const Waiting waiting;
  check(MPI_Allreduce(MPI_IN_PLACE, values.data(), to_count(std::ssize(values)), MPI_DOUBLE, to_op(op),
                      handle_->comm),
        "MPI_Allreduce", rank());
}

// int64_t is long here, which the check does not know to be MPI_INT64_T. NOLINTBEGIN(mpi-type-mismatch)
void Communicator::allreduce(std::span<std::int64_t> values, Reduce op) const {
  if (is_null()) return;
  const Waiting waiting;
  check(MPI_Allreduce(MPI_IN_PLACE, values.data(), to_count(std::ssize(values)), MPI_INT64_T, to_op(op),
                      handle_->comm),
        "MPI_Allreduce", rank());
}

void Communicator::allreduce(std::span<std::uint64_t> values, Reduce op) const {
  if (is_null()) return;
  const Waiting waiting;
  check(MPI_Allreduce(MPI_IN_PLACE, values.data(), to_count(std::ssize(values)), MPI_UINT64_T, to_op(op),
                      handle_->comm),
        "MPI_Allreduce", rank());
}
// NOLINTEND(mpi-type-mismatch)

std::vector<std::string> host_names(const Communicator& comm) {
  std::array<char, 256> mine{};
  static_assert(MPI_MAX_PROCESSOR_NAME <= 256);
  int length = 0;
  if (comm.is_null()) {
    gethostname(mine.data(), mine.size() - 1);
  } else {
    check(MPI_Get_processor_name(mine.data(), &length), "MPI_Get_processor_name", comm.rank());
  }
  std::vector<std::string> names;
  for (const auto& name : comm.allgather(mine)) names.emplace_back(name.data());
  return names;
}

}  // namespace pbmpi::mpi
