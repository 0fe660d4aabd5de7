/// A group of ranks that talk to each other.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <type_traits>
#include <vector>

namespace pbmpi::mpi {

/// A type whose values are sent as their bytes; all ranks run the same build on the same kind of machine.
template <class T>
concept Sendable = std::is_trivially_copyable_v<T>;

/// Operation that reduces the values of several ranks to one.
enum class Reduce { sum, min, max };

/// The place of each rank's elements in the gathered array: counts[r] of them from displacements[r] on.
struct GatherLayout {
  std::vector<int> counts;
  std::vector<int> displacements;

  /// Packs one rank's elements after the other's. Throws core::RunError if MPI's int counts cannot hold them.
  static GatherLayout packed(std::span<const std::int64_t> counts);
};

/// Owns a communicator (dup, split) or borrows one (world). Move-only. Every call is collective unless it
/// says otherwise, and throws core::RunError with the name of the MPI call, MPI's message and the rank.
///
/// The null communicator (default constructed) acts as one rank and never calls MPI, so that code for several
/// ranks also runs without a Session.
class Communicator {
 public:
  static constexpr int root = 0;

  Communicator();
  ~Communicator();
  Communicator(Communicator&&) noexcept;
  Communicator& operator=(Communicator&&) noexcept;

  /// All ranks of the program; borrowed. Not collective.
  static Communicator world();
  /// An owned communicator of the same ranks as another library's, which is given as its MPI_Comm_c2f handle.
  /// Its errors are returned, whatever error handler the original has. Throws core::InputError if MPI does
  /// not run, or there is no such communicator.
  static Communicator dup_of(int fortran_handle);
  /// An owned communicator of the same ranks, whose messages never match those of another. Null stays null.
  Communicator dup() const;
  /// An owned communicator of the ranks that give the same `group` (>= 0), in their present order. Null stays
  /// null.
  Communicator split(int group) const;

  bool is_null() const { return handle_ == nullptr; }
  int rank() const;
  int size() const;
  bool is_root() const { return rank() == root; }
  /// The MPI_Comm_c2f handle, which other libraries take without mpi.h; that of MPI_COMM_NULL for the null
  /// communicator.
  int fortran_handle() const;

  void barrier() const;

  /// Copies the `values` of `from` to every rank; the lengths are equal everywhere.
  template <Sendable T>
  void bcast(std::span<T> values, int from = root) const {
    bcast_bytes(values.data(), values.size(), sizeof(T), from);
  }
  template <Sendable T>
  void bcast_value(T& value, int from = root) const {
    bcast(std::span<T>(&value, 1), from);
  }
  /// Replaces the text of every other rank with that of `from`, of any length.
  void bcast_string(std::string& text, int from = root) const;

  /// The `value` of every rank, [num_ranks].
  template <Sendable T>
  std::vector<T> allgather(const T& value) const {
    std::vector<T> all(size());
    allgather_bytes(&value, all.data(), sizeof(T));
    return all;
  }
  /// Every rank's values, one rank's after the other's.
  template <Sendable T>
  std::vector<T> allgatherv(std::span<const T> mine) const {
    const std::vector<std::int64_t> counts = allgather(static_cast<std::int64_t>(mine.size()));
    const GatherLayout layout = GatherLayout::packed(counts);
    std::vector<T> all(layout.displacements.back() + layout.counts.back());
    allgatherv_bytes(mine.data(), mine.size(), all.data(), layout, sizeof(T));
    return all;
  }

  /// Reduces element by element over the ranks, in place; the lengths are equal everywhere.
  void allreduce(std::span<double> values, Reduce op) const;
  void allreduce(std::span<std::int64_t> values, Reduce op) const;
  void allreduce(std::span<std::uint64_t> values, Reduce op) const;

  /// Blocking message between two ranks. The lengths must agree: core::RunError at the receiver otherwise.
  template <Sendable T>
  void send(std::span<const T> values, int to, int tag = 0) const {
    send_bytes(values.data(), values.size(), sizeof(T), to, tag);
  }
  template <Sendable T>
  void recv(std::span<T> values, int from, int tag = 0) const {
    recv_bytes(values.data(), values.size(), sizeof(T), from, tag);
  }

 private:
  struct Handle;
  explicit Communicator(std::unique_ptr<Handle> handle);

  void bcast_bytes(void* data, std::size_t count, std::size_t element_size, int from) const;
  void allgather_bytes(const void* mine, void* all, std::size_t element_size) const;
  void allgatherv_bytes(const void* mine, std::size_t count, void* all, const GatherLayout& layout,
                        std::size_t element_size) const;
  void send_bytes(const void* data, std::size_t count, std::size_t element_size, int to, int tag) const;
  void recv_bytes(void* data, std::size_t count, std::size_t element_size, int from, int tag) const;

  std::unique_ptr<Handle> handle_;
};

/// The host of each rank, by rank, as MPI names it.
std::vector<std::string> host_names(const Communicator& comm);

}  // namespace pbmpi::mpi
