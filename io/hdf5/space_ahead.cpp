#include "io/hdf5/space_ahead.h"

#include "core/error.h"
#include "io/hdf5/chunk_ranges.h"

namespace pbmpi::io {

void SpaceAhead::cover(hid_t file, const std::string& dataset, hsize_t needed, hsize_t ahead) {
  hsize_t& covered = covered_[dataset];
  if (needed <= covered) return;
  const auto opened =
      owned<Dataset>(H5Dopen2(file, dataset.c_str(), H5P_DEFAULT), "H5Dopen(" + dataset + ")");
  const std::string why = target_.reserve(bytes_of_rows(opened.id(), covered, needed + ahead));
  if (!why.empty()) throw core::RunError("no disk space for the next rows of " + dataset + ": " + why);
  covered = needed + ahead;
}

}  // namespace pbmpi::io
