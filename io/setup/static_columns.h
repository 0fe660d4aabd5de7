/// The columns that are written once: bodies, geoms, joints, worlds and ranks.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "core/vector.h"
#include "io/hdf5/file_ranks.h"
#include "io/hdf5/hdf5_handle.h"
#include "io/hdf5/rows.h"
#include "io/setup/run_setup.h"

namespace pbmpi::io {

/// The rows of a table that a rank writes.
struct OwnRows {
  std::vector<Range> ranges;
  hsize_t num_rows = 0;  ///< of all ranks
};

/// The file in which columns are made, and then filled. `is_new`: root alone has it open, and makes the
/// datasets; the other ranks have no `id`. Otherwise all ranks have it open, and write their rows.
struct ColumnFile {
  hid_t id;
  bool is_new;
};

/// Makes or fills columns of one group: this rank has the rows of OwnRows, in order. Every call is
/// collective, and throws the same core::RunError on every rank.
class ColumnWriter {
 public:
  /// `ranks` is borrowed.
  ColumnWriter(const FileRanks& ranks, ColumnFile file, std::string group, OwnRows rows);

  /// `item`: extents of a value; {} = one number.
  void numbers(const std::string& name, const std::vector<double>& values, const std::string& unit = "",
               const std::vector<hsize_t>& item = {});
  void numbers(const std::string& name, const std::vector<std::int32_t>& values);
  void numbers(const std::string& name, const std::vector<std::int64_t>& values,
               const std::vector<hsize_t>& item = {});
  /// `length` bytes each; 0 = the length of the longest text on any rank.
  void texts(const std::string& name, const std::vector<std::string>& values, std::size_t length = 0);

 private:
  void write(const std::string& name, const Datatype& type, const void* data,
             const std::vector<hsize_t>& item, const std::string& unit);

  const FileRanks& ranks_;
  ColumnFile file_;
  std::string group_;
  OwnRows rows_;
};

/// Appends the numbers of a vector, of a quaternion (w, x, y, z), of a matrix row by row.
void append(std::vector<double>& values, const core::Vec3& v);
void append(std::vector<double>& values, const core::Quat& q);
void append(std::vector<double>& values, const core::Mat3& m);
void append(std::vector<double>& values, const std::array<double, 3>& numbers);

/// Makes, or fills, /particles/bodies (without the moving part), /geoms, /pair_materials, /joints,
/// /connectivity, /worlds, /world_parameters and /ranks. Collective; throws the same core::RunError on every
/// rank.
void write_static_columns(const FileRanks& ranks, ColumnFile file, const RunSetup& setup);

/// Bytes of the static columns, with names of usual length.
std::int64_t estimate_static_bytes(const RunShape& shape);

/// Parts of write_static_columns(), in its order.
void write_bodies(const FileRanks& ranks, ColumnFile file, const RunSetup& setup);
void write_geoms(const FileRanks& ranks, ColumnFile file, const RunSetup& setup);
void write_pair_materials(const FileRanks& ranks, ColumnFile file, const RunSetup& setup);
void write_joints(const FileRanks& ranks, ColumnFile file, const RunSetup& setup);
/// Writes /connectivity/joints in the form of H5MD: the joints between two bodies.
void write_connectivity(const FileRanks& ranks, ColumnFile file, const RunSetup& setup);
void write_worlds(const FileRanks& ranks, ColumnFile file, const RunSetup& setup);
/// Writes /world_parameters, if worlds have some.
void write_world_parameters(const FileRanks& ranks, ColumnFile file, const RunSetup& setup);

/// [num_worlds + 1] where the items of each world begin; `count` gives their number from its model.
/// Collective.
std::vector<std::int64_t> offsets(const FileRanks& ranks, const RunSetup& setup,
                                  const std::function<std::size_t(const model::Model&)>& count);

/// This rank's rows of a table in (world, item) order; `count` gives the number of items from a world's
/// model. Collective.
OwnRows rows_in_world_order(const FileRanks& ranks, const RunSetup& setup,
                            const std::function<std::size_t(const model::Model&)>& count);

/// Bytes of the longest of these names.
template <std::size_t N>
constexpr std::size_t longest(const std::array<std::string_view, N>& names) {
  std::size_t length = 1;
  for (const std::string_view name : names) length = name.size() > length ? name.size() : length;
  return length;
}

}  // namespace pbmpi::io
