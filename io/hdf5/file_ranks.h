/// The ranks that write one file together: how they exchange rows, and agree on errors.
#pragma once

#include <cstddef>
#include <cstdint>
#include <exception>
#include <span>
#include <string>
#include <vector>

#include "core/error.h"

namespace pbmpi::io {

/// This rank's place in the group, and the group's communicator.
struct FileGroup {
  int fortran_communicator = 0;  ///< MPI_Comm_c2f of the ranks that write together
  int rank = 0;
  int num_ranks = 1;
};

/// Borrows the communicator. Every call is collective, except rank(), size() and is_root().
class FileRanks {
 public:
  explicit FileRanks(const FileGroup& group);

  int rank() const { return rank_; }
  int size() const { return size_; }
  bool is_root() const { return rank_ == 0; }

  /// Returns root's text on every rank.
  std::string broadcast(std::string text) const;
  bool broadcast(bool flag) const;
  /// Element-wise sum over the ranks, in place.
  void sum(std::span<std::int64_t> values) const;
  std::int64_t max(std::int64_t value) const;
  /// Sends messages[r] to rank r; returns what the ranks sent to this one, in order of rank. 2 GiB at most.
  std::vector<std::byte> exchange(const std::vector<std::vector<std::byte>>& messages) const;

  /// The error of the lowest rank that has one, with the rank's number if it is not root; empty if no rank
  /// has one.
  std::string first_error(const std::string& error) const;

  /// Does `work` on every rank; if it throws on any rank, throws Error with the same message on all.
  template <class Error = core::RunError, class Work>
  void together(Work&& work) const {
    std::string error;
    try {
      work();
    } catch (const std::exception& e) {
      error = e.what();
    }
    if (const std::string first = first_error(error); !first.empty()) throw Error(first);
  }

 private:
  int fortran_communicator_;
  int rank_;
  int size_;
};

}  // namespace pbmpi::io
