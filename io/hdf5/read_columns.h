/// Reads datasets and attributes of a file, serially. Errors are core::RunError; the callers turn them into
/// core::InputError with the file's name.
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "io/hdf5/hdf5_handle.h"

namespace pbmpi::io {

/// Opens any HDF5 file read-only, also while it is written, and on file systems without locks. Throws
/// core::RunError.
File open_unlocked(const std::string& path);

/// Opens `path` read-only and checks that it is a pbmpi-run file that this program understands. Throws
/// core::InputError.
File open_run(const std::string& path);

/// open_run() for a file of type `type`, whose layout has the version `major`. From minor version
/// `sealed_since` on the file must have a seal (core/system/seal.h); a broken seal is always refused, before
/// HDF5 reads the file.
File open_file(const std::string& path, const std::string& type, std::int64_t major,
               std::optional<std::int64_t> sealed_since = std::nullopt);

/// Does the file have a group or dataset of this path? Its parent must exist.
bool has_object(hid_t file, const std::string& path);

/// Extent of a dataset.
std::vector<hsize_t> dims_of(hid_t file, const std::string& path);

/// Reads the first `num_rows` rows, row-major; all rows if num_rows < 0. Throws if there are fewer, or if a
/// row does not have `row_values` values (0 = any number).
std::vector<double> read_doubles(hid_t file, const std::string& path, std::int64_t num_rows = -1,
                                 hsize_t row_values = 0);
std::vector<std::int64_t> read_integers(hid_t file, const std::string& path, std::int64_t num_rows = -1);
std::vector<std::string> read_texts(hid_t file, const std::string& path, std::int64_t num_rows = -1);

/// The first rows of a dataset as the bytes that the file stores.
struct RawRows {
  std::string path;
  Dataset dataset;
  Datatype type;
  std::vector<hsize_t> dims;  ///< row first; empty for a scalar, which counts as one row
  hsize_t num_rows = 0;
  std::size_t row_bytes = 0;

  /// Reads rows [first, first + count) into `values`.
  void read(hsize_t first, hsize_t count, void* values) const;
  /// Writes them, serially.
  void write(hsize_t first, hsize_t count, const void* values) const;
};
/// `num_rows` as in read_doubles().
RawRows raw_rows(hid_t file, const std::string& path, std::int64_t num_rows = -1);

/// The names in a group, in alphabetical order.
std::vector<std::string> names_in(hid_t file, const std::string& group);

std::int64_t integer_attribute(hid_t file, const std::string& object, const std::string& name);

/// All attributes of an object as text; the values of an array are separated by a dot ("1.0").
std::map<std::string, std::string> attributes_as_text(hid_t file, const std::string& object);

/// All scalar datasets of a group as text.
std::map<std::string, std::string> scalars_as_text(hid_t file, const std::string& group);

}  // namespace pbmpi::io
