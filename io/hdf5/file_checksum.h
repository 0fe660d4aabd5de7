/// Checksums inside a file that grows: one for everything that is written once, and one for each row of its
/// tables.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>

#include "io/hdf5/hdf5_handle.h"

namespace pbmpi::io {

/// Group of the checksums of rows: it has a dataset [rows] of uint64 for each table, whose attribute
/// `columns` lists the paths of the columns, one a line. A row's checksum covers its bytes in the file,
/// column by column.
inline constexpr const char* row_checksums = "/checksums";

/// The checksum dataset of the table whose first column is `first_column` (a path).
std::string row_checksum_path(const std::string& first_column);

/// Creates the root's attributes for the fixed and the end checksum, each 0: unknown. Part of the skeleton:
/// collective.
void create_checksum_attributes(hid_t root);

/// Stores, serially, the checksum of everything that does not change while the file grows: names, types,
/// attributes, and the bytes of datasets that are not chunked. The attributes that a CommitRecord overwrites
/// are left out.
void store_fixed_checksum(hid_t file);
/// Stores, serially, the checksum of those attributes and of /world_results, once they have been written for
/// the last time.
void store_end_checksum(hid_t file);

/// Stores, serially, the checksums of all rows of all tables.
void store_row_checksums(hid_t file);

/// Throws core::RunError where one of the two is stored and does not match. Files before layout 1.4 have
/// none.
void check_checksums(hid_t file);

/// Throws core::RunError unless the first rows of each table match their checksums. `num_rows`: called with
/// the name of a table's checksum dataset in the group; none = the table is skipped.
void check_rows(hid_t file,
                const std::function<std::optional<std::int64_t>(const std::string& name)>& num_rows);

}  // namespace pbmpi::io
