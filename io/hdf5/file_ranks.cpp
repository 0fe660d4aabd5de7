#include "io/hdf5/file_ranks.h"

#include <mpi.h>

#include <array>
#include <limits>
#include <numeric>

namespace pbmpi::io {
namespace {

constexpr int root = 0;

void check_mpi(int code, const char* call, int rank) {
  if (code == MPI_SUCCESS) return;
  std::array<char, MPI_MAX_ERROR_STRING> text{};
  int length = 0;
  MPI_Error_string(code, text.data(), &length);
  throw core::RunError("rank " + std::to_string(rank) + ": " + call + ": " + text.data());
}

int to_count(std::size_t bytes) {
  if (bytes > std::numeric_limits<int>::max())
    throw core::RunError("more than 2 GiB in one message between ranks");
  return static_cast<int>(bytes);
}

}  // namespace

FileRanks::FileRanks(const FileGroup& group)
    : fortran_communicator_(group.fortran_communicator), rank_(group.rank), size_(group.num_ranks) {}

std::string FileRanks::broadcast(std::string text) const {
  const MPI_Comm comm = MPI_Comm_f2c(fortran_communicator_);
  std::int64_t length = static_cast<std::int64_t>(text.size());
  check_mpi(MPI_Bcast(&length, 1, MPI_INT64_T, root, comm), "MPI_Bcast", rank_);
  text.resize(static_cast<std::size_t>(length));
  check_mpi(MPI_Bcast(text.data(), static_cast<int>(length), MPI_CHAR, root, comm), "MPI_Bcast", rank_);
  return text;
}

bool FileRanks::broadcast(bool flag) const {
  int value = flag ? 1 : 0;
  check_mpi(MPI_Bcast(&value, 1, MPI_INT, root, MPI_Comm_f2c(fortran_communicator_)), "MPI_Bcast", rank_);
  return value != 0;
}

void FileRanks::sum(std::span<std::int64_t> values) const {
  // int64_t is long here, which the check does not know to be MPI_INT64_T. NOLINTNEXTLINE(mpi-type-mismatch)
  check_mpi(MPI_Allreduce(MPI_IN_PLACE, values.data(), static_cast<int>(values.size()), MPI_INT64_T, MPI_SUM,
                          MPI_Comm_f2c(fortran_communicator_)),
            "MPI_Allreduce", rank_);
}

std::int64_t FileRanks::max(std::int64_t value) const {
  std::array<std::int64_t, 1> values{value};
  check_mpi(MPI_Allreduce(MPI_IN_PLACE, values.data(), 1, MPI_INT64_T, MPI_MAX,
                          MPI_Comm_f2c(fortran_communicator_)),
            "MPI_Allreduce", rank_);
  return values[0];
}

std::vector<std::byte> FileRanks::exchange(const std::vector<std::vector<std::byte>>& messages) const {
  const MPI_Comm comm = MPI_Comm_f2c(fortran_communicator_);
  std::vector<std::byte> out, in;
  std::vector<int> out_counts, in_counts(messages.size());
  for (const auto& message : messages) {
    out.insert(out.end(), message.begin(), message.end());
    out_counts.push_back(to_count(message.size()));
  }
  to_count(out.size());
  check_mpi(MPI_Alltoall(out_counts.data(), 1, MPI_INT, in_counts.data(), 1, MPI_INT, comm), "MPI_Alltoall",
            rank_);
  in.resize(std::accumulate(in_counts.begin(), in_counts.end(), std::size_t{0}));
  to_count(in.size());
  const auto starts = [](const std::vector<int>& counts) {
    std::vector<int> offsets(counts.size());
    std::exclusive_scan(counts.begin(), counts.end(), offsets.begin(), 0);
    return offsets;
  };
  check_mpi(MPI_Alltoallv(out.data(), out_counts.data(), starts(out_counts).data(), MPI_BYTE, in.data(),
                          in_counts.data(), starts(in_counts).data(), MPI_BYTE, comm),
            "MPI_Alltoallv", rank_);
  return in;
}

std::string FileRanks::first_error(const std::string& error) const {
  const MPI_Comm comm = MPI_Comm_f2c(fortran_communicator_);
  int failed = error.empty() ? size_ : rank_;
  check_mpi(MPI_Allreduce(MPI_IN_PLACE, &failed, 1, MPI_INT, MPI_MIN, comm), "MPI_Allreduce", rank_);
  if (failed == size_) return {};
  std::array<char, 1024> text{};
  error.copy(text.data(), text.size() - 1);
  check_mpi(MPI_Bcast(text.data(), static_cast<int>(text.size()), MPI_CHAR, failed, comm), "MPI_Bcast",
            rank_);
  return failed == root ? text.data() : text.data() + (" (rank " + std::to_string(failed) + ")");
}

}  // namespace pbmpi::io
