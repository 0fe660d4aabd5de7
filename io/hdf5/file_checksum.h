/// Checksums inside a file that grows: over what is written once, and over each row of its tables.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>

#include "io/hdf5/hdf5_handle.h"

namespace pbmpi::io {

/// Group of the checksums of rows: for each table a dataset [rows] of uint64, whose attribute `columns` has
/// the paths of the columns, one a line. A row's checksum is over its bytes in the file, column by column.
inline constexpr const char* row_checksums = "/checksums";

/// The dataset of the table whose first column is `first_column` (a path).
std::string row_checksum_path(const std::string& first_column);

/// Makes the root's attributes for the next two, each 0: unknown. Part of the skeleton: collective.
void create_checksum_attributes(hid_t root);

/// Stores, serially, the checksum of all that does not change while the file grows: names, types, attributes,
/// and the bytes of datasets that are not chunked. The attributes that a CommitRecord overwrites are left
/// out.
void store_fixed_checksum(hid_t file);
/// Stores, serially, the checksum of those attributes, and of /world_results, when they have been written for
/// the last time.
void store_end_checksum(hid_t file);

/// Throws core::RunError where one of the two is stored and does not fit. Files before layout 1.4 have none.
void check_checksums(hid_t file);

/// Throws core::RunError unless the first rows of each table have their checksums. `num_rows`: of the dataset
/// with the checksums of a table, by its name in the group; none = this table is passed over.
void check_rows(hid_t file,
                const std::function<std::optional<std::int64_t>(const std::string& name)>& num_rows);

}  // namespace pbmpi::io
