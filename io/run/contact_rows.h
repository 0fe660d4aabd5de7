/// Group /contacts of a run's file: the contacts of the last step of each frame, with as many rows as there
/// are contacts.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "io/hdf5/growing_columns.h"
#include "io/run/frame_table.h"

namespace pbmpi::io {

/// Columns of /contacts/point, each a double; the attribute `columns` of the dataset lists them.
inline constexpr std::array<const char*, 24> contact_columns = {
    "world",      "geom_a",     "geom_b",     "body_a",    "body_b",    "awake",
    "position_x", "position_y", "position_z", "normal_x",  "normal_y",  "normal_z",
    "depth",      "mu",         "arm_x",      "arm_y",     "arm_z",     "normal_force",
    "friction_x", "friction_y", "friction_z", "impulse_x", "impulse_y", "impulse_z"};

/// The rows of one frame in /contacts/point, and their checksum (core/system/seal.h).
struct ContactSpan {
  std::int64_t first = 0, count = 0;
  std::uint64_t checksum = 0;
};

/// One dataset [rows][columns], the last of the file, so that its unused space is freed when the run is cut,
/// and a table with one row per frame that says where the frame's rows are. A frame that finds no room has no
/// rows and is counted as dropped.
class ContactRows {
 public:
  static constexpr const char* points = "/contacts/point";
  /// The group of the frames' table, and its columns.
  static constexpr const char* frame_group = "/contacts/frame";
  static std::vector<ColumnSpec> frame_columns();
  /// Rows for which a file has room; bytes of the rows that are expected, and of the others.
  static hsize_t capacity(const RunShape& shape);
  static std::int64_t expected_bytes(const RunShape& shape);
  static std::int64_t spare_bytes(const RunShape& shape);

  /// Makes the datasets.
  static void create(hid_t file, const RunShape& shape);
  /// Opens the datasets in the file of all ranks. `geom_offset`: [num_worlds + 1], where the geoms of each
  /// world begin; kept.
  ContactRows(hid_t file, const FileRanks& ranks, const RunShape& shape,
              std::vector<std::int64_t> geom_offset, hsize_t frames_held);

  /// Keeps this rank's contacts of a frame.
  void add(const FrameSource& source);
  /// Collective: sends waiting rows to the ranks that write them, and determines where they are written.
  void settle();
  /// Writes the settled rows of this rank.
  void write();

  GrowingTable& frames() { return frames_; }
  /// Rows written or settled.
  hsize_t num_rows() const { return settled_; }
  void close();
  void cut(hid_t file, std::vector<core::ByteRange>& unused) const;

 private:
  using Row = std::array<double, contact_columns.size()>;
  /// This rank's rows of a frame, world by world.
  struct Part {
    std::vector<std::int64_t> num_rows;  ///< [num_worlds]
    std::vector<Row> rows;
  };

  void add_world(const FrameSource& source, const stepping::LocalWorld& world, Part& part) const;
  /// Rows of each world of each waiting frame, over all ranks: [frames][num_worlds].
  std::vector<std::int64_t> count_rows() const;
  /// Each rank's waiting rows of the frames that it writes.
  std::vector<Row> exchange(const std::vector<std::int64_t>& counts, Range frames) const;

  const FileRanks& ranks_;
  std::vector<std::int64_t> geom_offset_;
  hsize_t capacity_;
  double substep_s_;
  Dataset dataset_;
  GrowingTable frames_;
  std::vector<Part> waiting_;  ///< [frames]
  std::vector<Row> own_rows_;  ///< settled, of this rank's frames
  hsize_t first_own_ = 0;      ///< row at which they are written
  hsize_t settled_ = 0, written_ = 0;
};

/// Spans of the first frames; none if the file has no contacts. Throws core::RunError where the spans are not
/// consecutive.
std::vector<ContactSpan> read_contact_spans(hid_t file, std::int64_t num_frames);

/// Throws core::RunError unless the rows of each span have its checksum.
void check_contacts(hid_t file, const std::vector<ContactSpan>& spans);

}  // namespace pbmpi::io
