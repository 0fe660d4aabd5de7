/// Copies everything in a run's file except its rows.
#pragma once

#include <cstdint>
#include <map>
#include <set>
#include <string>
#include <vector>

#include "io/hdf5/hdf5_handle.h"

namespace pbmpi::io {

/// How the new file's dataset is created; its type and attributes are those of the old one.
struct GrownDataset {
  hsize_t num_rows = 0;
  hsize_t num_items = 0;     ///< > 0: another extent of the second dimension
  hsize_t rows_a_chunk = 0;  ///< 0: as create_growing() chooses
};

struct CopyPlan {
  std::map<std::string, GrownDataset> grown;  ///< by path; created without writing rows
  std::set<std::string> left_out;             ///< paths of datasets; groups that hold one as `value` go, too
  std::set<std::string> made_by_caller;       ///< paths of datasets that are skipped
};

/// Paths of all links of a file below the root, in alphabetical order.
std::vector<std::string> paths_in(hid_t file);

/// Address of an object in its file; all paths of one object have the same.
haddr_t address_of(hid_t file, const std::string& path);

/// Creates in the empty file `to` what `from` has: groups, attributes, datasets, and further names of
/// datasets.
void copy_objects(hid_t from, hid_t to, const CopyPlan& plan);

/// Throws core::InputError unless the datasets that are written once have the same bytes in both files,
/// except those of /parameters and /ranks.
void require_same_objects(hid_t a, const std::string& path_a, hid_t b, const std::string& path_b,
                          const std::set<std::string>& growing);

}  // namespace pbmpi::io
