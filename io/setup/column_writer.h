/// Columns that are written once, where each rank writes its own rows.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "core/vector.h"
#include "io/hdf5/file_ranks.h"
#include "io/hdf5/hdf5_handle.h"
#include "io/hdf5/rows.h"

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

}  // namespace pbmpi::io
