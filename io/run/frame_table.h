/// The groups of a run's file that grow with its frames, each as one table: its columns, and the function
/// that puts a frame's row into them.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "io/hdf5/growing_columns.h"
#include "io/run/run_file.h"
#include "model/state_parts.h"

namespace pbmpi::io {

/// What the items of a row belong to; `run`: a row has one item, and the columns are one-dimensional.
enum class Items { run, ranks, worlds, bodies, joints };

/// Which frames have a row: all frames, or those in which the bodies are stored.
enum class Rows { frames, recorded };

/// A finished frame, and the places of its items in a row.
struct FrameSource {
  const stepping::FrameRecord& frame;
  const stepping::WorldTable& table;
  const std::vector<std::int64_t>& joint_offset;  ///< [num_worlds + 1], as WorldTable::body_offset
  int rank = 0;

  hsize_t own_rank() const { return static_cast<hsize_t>(rank); }
  hsize_t first_body(const stepping::LocalWorld& world) const {
    return static_cast<hsize_t>(table.body_offset[world.id]);
  }
  hsize_t first_joint(const stepping::LocalWorld& world) const {
    return static_cast<hsize_t>(joint_offset[world.id]);
  }
};

struct FrameTable {
  std::string group;
  std::vector<ColumnSpec> columns;
  Items items;
  Rows rows;
  /// Puts this rank's items into the row that begin_row() has begun, columns in the order of `columns`. For a
  /// table with Items::run it is called on root only.
  void (*put)(const FrameSource& source, GrowingTable& row);
};

/// Number of items of a row; 0 for Items::run.
std::int64_t num_items(const FrameTable& table, const RunShape& shape);

/// Bytes of a row, all ranks together.
std::size_t row_bytes(const FrameTable& table, const RunShape& shape);

/// Begins the next row with the items that this rank has in this frame.
void begin_row(const FrameTable& table, const FrameSource& source, GrowingTable& row);

/// The columns NAME/value of a table of bodies, and one world's items in them, from item `first` on.
std::vector<ColumnSpec> value_columns(std::span<const model::BodyColumn> columns);
void put_values(std::span<const model::BodyColumn> columns, const model::State& state, hsize_t first,
                GrowingTable& row);

/// Groups of the file, in the order in which they are created.
std::vector<FrameTable> body_tables();
std::vector<FrameTable> observable_tables(const OptionalColumns& optional);
std::vector<FrameTable> joint_tables(const OptionalColumns& optional);
std::vector<FrameTable> timing_tables(const OptionalColumns& optional);
std::vector<FrameTable> estimate_tables(const OptionalColumns& optional);

/// All tables with these optional columns.
std::vector<FrameTable> frame_tables(const OptionalColumns& optional);
/// All tables of this run.
std::vector<FrameTable> frame_tables(const RunShape& shape);
/// All tables that a run's file can have.
std::vector<FrameTable> all_frame_tables();

/// Throws core::RunError unless the data that are written once, the data that the end of the run has written,
/// and every committed row match their checksums, as far as the file's layout has them.
void check_run(hid_t file);

}  // namespace pbmpi::io
