/// Disk space for the next rows of a file.
#pragma once

#include <map>
#include <string>

#include "io/file/output_target.h"
#include "io/hdf5/hdf5_handle.h"

namespace pbmpi::io {

/// Reserves space for rows before they are written, so that a full disk ends the run between two writes. It
/// reserves at most one step ahead, so that a killed run keeps little unused space. Root only; borrows the
/// published file.
class SpaceAhead {
 public:
  explicit SpaceAhead(const OutputTarget& target) : target_(target) {}

  /// If `needed` rows of a dataset of `file` are not all covered, reserves space for them and `ahead` more.
  /// Throws core::RunError if the disk has no room.
  void cover(hid_t file, const std::string& dataset, hsize_t needed, hsize_t ahead);

 private:
  const OutputTarget& target_;
  std::map<std::string, hsize_t> covered_;  ///< rows covered, by dataset
};

}  // namespace pbmpi::io
