/// Disk space for what a file will hold next.
#pragma once

#include <map>
#include <string>

#include "io/file/output_target.h"
#include "io/hdf5/hdf5_handle.h"

namespace pbmpi::io {

/// Reserves space for rows before they are written, so that a disk which is full ends the run between two
/// writes, and no more than a step ahead, so that a killed run keeps little that it does not use. Root only;
/// borrows the published file.
class SpaceAhead {
 public:
  explicit SpaceAhead(const OutputTarget& target) : target_(target) {}

  /// If `needed` rows of a dataset of `file` are not all covered, covers them and `ahead` more. Throws
  /// core::RunError if the disk has no room.
  void cover(hid_t file, const std::string& dataset, hsize_t needed, hsize_t ahead);

 private:
  const OutputTarget& target_;
  std::map<std::string, hsize_t> covered_;  ///< rows of each dataset
};

}  // namespace pbmpi::io
