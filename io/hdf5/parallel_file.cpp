#include "io/hdf5/parallel_file.h"

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

/// Root alone writes metadata, and no rank drops a cache entry that another rank keeps: HDF5 broadcasts
/// entries from root in collective calls, and hangs if ranks disagree on which entries they need.
void set_metadata_cache(const PropertyList& access) {
  H5AC_cache_config_t cache{};
  cache.version = H5AC__CURR_CACHE_CONFIG_VERSION;
  check(H5Pget_mdc_config(access.id(), &cache), "H5Pget_mdc_config");
  cache.evictions_enabled = 0;
  cache.incr_mode = H5C_incr__off;
  cache.flash_incr_mode = H5C_flash_incr__off;
  cache.decr_mode = H5C_decr__off;
  cache.metadata_write_strategy = H5AC_METADATA_WRITE_STRATEGY__PROCESS_0_ONLY;
  check(H5Pset_mdc_config(access.id(), &cache), "H5Pset_mdc_config");
}

PropertyList access_through(MPI_Comm comm) {
  auto access = owned<PropertyList>(H5Pcreate(H5P_FILE_ACCESS), "H5Pcreate");
  check(H5Pset_fapl_mpio(access.id(), comm, MPI_INFO_NULL), "H5Pset_fapl_mpio");
  set_metadata_cache(access);
  return access;
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

File FileRanks::create(const std::string& path) const {
  const PropertyList access = access_through(MPI_Comm_f2c(fortran_communicator_));
  // The oldest format, chosen on purpose: its superblock has no "open for writing" mark, which after a kill
  // would keep readers out until someone runs h5clear.
  check(H5Pset_libver_bounds(access.id(), H5F_LIBVER_EARLIEST, H5F_LIBVER_LATEST), "H5Pset_libver_bounds");
  constexpr hsize_t metadata_block =
      hsize_t{64} * 1024;  // few, large metadata writes instead of many of 2 KiB
  check(H5Pset_meta_block_size(access.id(), metadata_block), "H5Pset_meta_block_size");
  return owned<File>(H5Fcreate(path.c_str(), H5F_ACC_TRUNC, H5P_DEFAULT, access.id()), "H5Fcreate");
}

File open_alone(const std::string& path) {
  const PropertyList access = access_through(MPI_COMM_SELF);
  return owned<File>(H5Fopen(path.c_str(), H5F_ACC_RDWR, access.id()), "H5Fopen");
}

PropertyList collective_transfer() {
  auto transfer = owned<PropertyList>(H5Pcreate(H5P_DATASET_XFER), "H5Pcreate");
  check(H5Pset_dxpl_mpio(transfer.id(), H5FD_MPIO_COLLECTIVE), "H5Pset_dxpl_mpio");
  // One operation for all chunks: if it fails on one rank, no other rank is left in a loop over chunks.
  check(H5Pset_dxpl_mpio_chunk_opt(transfer.id(), H5FD_MPIO_CHUNK_ONE_IO), "H5Pset_dxpl_mpio_chunk_opt");
  // Each rank writes its own bytes: the collective buffering of Open MPI 4.1 (OMPIO, fcoll vulcan) drops the
  // errors of its aggregators, so a full disk would look like success.
  check(H5Pset_dxpl_mpio_collective_opt(transfer.id(), H5FD_MPIO_INDIVIDUAL_IO),
        "H5Pset_dxpl_mpio_collective_opt");
  return transfer;
}

bool was_collective(const PropertyList& transfer) {
  H5D_mpio_actual_io_mode_t mode = H5D_MPIO_NO_COLLECTIVE;
  check(H5Pget_mpio_actual_io_mode(transfer.id(), &mode), "H5Pget_mpio_actual_io_mode");
  return mode == H5D_MPIO_CHUNK_COLLECTIVE || mode == H5D_MPIO_CONTIGUOUS_COLLECTIVE;
}

}  // namespace pbmpi::io
