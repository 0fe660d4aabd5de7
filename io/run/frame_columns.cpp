#include "io/run/frame_columns.h"

#include <algorithm>
#include <utility>

#include "io/hdf5/columns.h"
#include "io/setup/static_columns.h"

namespace pbmpi::io {
namespace {

/// Bytes that a frame adds to the file, on average.
std::size_t mean_bytes(const RunShape& shape) {
  const FrameBytes bytes = frame_bytes(shape);
  return std::max<std::size_t>(
      bytes.every_frame + bytes.recorded / static_cast<std::size_t>(shape.record_every), 1);
}

/// Largest number of frames that wait: on all ranks together they stay below 32 MiB, unless one frame is
/// larger.
std::int64_t frames_to_hold(const RunShape& shape) {
  constexpr std::size_t most_bytes = std::size_t{32} << 20;
  return std::max<std::int64_t>(static_cast<std::int64_t>(most_bytes / mean_bytes(shape)), 1);
}

TableShape table_shape(const FrameTable& table, const RunShape& shape) {
  const auto items = static_cast<hsize_t>(num_items(table, shape));
  const auto held = static_cast<hsize_t>(frames_to_hold(shape));
  if (table.rows == Rows::frames) return {static_cast<hsize_t>(shape.num_frames), items, held};
  return {static_cast<hsize_t>(shape.num_recorded()), items,
          held / static_cast<hsize_t>(shape.record_every) + 1};
}

void link(hid_t file, const std::string& from, const std::string& to) {
  check(H5Lcreate_hard(file, from.c_str(), file, to.c_str(), H5P_DEFAULT, H5P_DEFAULT),
        "H5Lcreate_hard(" + to + ")");
}

/// H5MD wants step and time next to each value; all four elements share one pair.
void link_step_and_time(hid_t file) {
  for (const model::BodyColumn& element : std::span(model::body_columns).subspan<1>()) {
    for (const char* column : {"step", "time"}) {
      const std::string from = std::string("/particles/bodies/position/") + column;
      const std::string to = std::string("/particles/bodies/") + element.name + "/" + column;
      link(file, from, to);
    }
  }
}

/// Makes each column of a table of observables an element of H5MD, with the step and the time of its frames:
/// /observables/world/energy is also /observables/energy/value.
void link_observables(hid_t file, const std::vector<FrameTable>& tables) {
  const std::string root = "/observables/";
  for (const FrameTable& table : tables) {
    if (!table.group.starts_with(root)) continue;
    const std::string prefix = table.items == Items::joints ? "joint_" : "";
    for (const ColumnSpec& column : table.columns) {
      const std::string element = root + prefix + column.name;
      create_group(file, element);
      link(file, table.group + "/" + column.name, element + "/value");
      for (const char* name : {"step", "time"})
        link(file, std::string("/timings/frame/") + name, element + "/" + name);
    }
  }
}

}  // namespace

FrameBytes frame_bytes(const RunShape& shape) {
  FrameBytes bytes = {0, 0};
  for (const FrameTable& table : frame_tables(shape))
    (table.rows == Rows::frames ? bytes.every_frame : bytes.recorded) += row_bytes(table, shape);
  return bytes;
}

std::int64_t estimate_file_bytes(const RunShape& shape) {
  const FrameBytes frame = frame_bytes(shape);
  const std::int64_t contact_bytes = shape.optional.contacts ? ContactRows::expected_bytes(shape) : 0;
  // A rank's host.
  constexpr std::int64_t rank_bytes = 40;
  // Object headers and group tables of about 160 objects, and some parameters.
  constexpr std::int64_t metadata_bytes = std::int64_t{160} * 1024;
  return shape.num_frames * static_cast<std::int64_t>(frame.every_frame) +
         shape.num_recorded() * static_cast<std::int64_t>(frame.recorded) + estimate_static_bytes(shape) +
         contact_bytes + shape.num_ranks * rank_bytes + static_cast<std::int64_t>(EventColumns::bytes()) +
         metadata_bytes;
}

void FrameColumns::create(hid_t file, const RunShape& shape) {
  const std::vector<FrameTable> groups = frame_tables(shape);
  EventColumns::create(file);
  for (const FrameTable& group : groups)
    GrowingTable::create(file, group.group, group.columns, table_shape(group, shape));
  link_step_and_time(file);
  link_observables(file, groups);
  if (shape.optional.contacts) ContactRows::create(file, shape);
}

FrameColumns::FrameColumns(hid_t file, const FileRanks& ranks, const RunSetup& setup, const RunShape& shape)
    : ranks_(ranks),
      table_(setup.table),
      record_every_(shape.record_every),
      bytes_each_(mean_bytes(shape)),
      first_frame_(shape.first_frame),
      frames_held_(frames_to_hold(shape)),
      groups_(frame_tables(shape)),
      events_(file, ranks),
      joint_offset_(offsets(ranks, setup, [](const auto& m) { return m.joints.size(); })) {
  std::vector<std::int64_t> geom_offset;  // determined by all ranks, before what may fail on one of them
  if (shape.optional.contacts)
    geom_offset = offsets(ranks, setup, [](const auto& m) { return m.geoms.size(); });
  for (const FrameTable& group : groups_)
    rows_.emplace_back(file, ranks, group.group, group.columns, table_shape(group, shape));
  if (shape.optional.contacts)
    contacts_.emplace(file, ranks, shape, std::move(geom_offset), static_cast<hsize_t>(frames_held_));
}

void FrameColumns::add(const stepping::FrameRecord& frame) {
  core::require_invariant(frame.frame == first_frame_ + frames_added_, "frames come in order");
  ++frames_added_;
  const FrameSource source{frame, table_, joint_offset_, ranks_.rank()};
  if (contacts_) contacts_->add(source);
  for (std::size_t i = 0; i < groups_.size(); ++i) {
    if (groups_[i].rows == Rows::recorded && !is_recorded(frame)) continue;
    begin_row(groups_[i], source, rows_[i]);
    if (groups_[i].items != Items::run || ranks_.is_root()) groups_[i].put(source, rows_[i]);
  }
}

std::vector<GrowingTable*> FrameColumns::tables() {
  std::vector<GrowingTable*> all = {&events_.rows()};
  for (GrowingTable& rows : rows_) all.push_back(&rows);
  return all;
}

std::vector<ColumnRows> FrameColumns::column_rows() const {
  std::vector<ColumnRows> all;
  for (std::size_t i = 0; i < groups_.size(); ++i) {
    const hsize_t rows = rows_[i].num_rows() + rows_[i].num_waiting();
    for (const ColumnSpec& column : groups_[i].columns)
      all.push_back({groups_[i].group + "/" + column.name, rows,
                     groups_[i].rows == Rows::recorded ? record_every_ : 1});
  }
  if (contacts_) all.push_back({ContactRows::points, contacts_->num_rows(), 1});
  return all;
}

hsize_t FrameColumns::frames_in(std::size_t bytes) const {
  return std::max<std::size_t>(bytes / bytes_each_, 1);
}

void FrameColumns::settle() {
  if (contacts_) contacts_->settle();
  for (GrowingTable* table : tables()) table->settle();
}

void FrameColumns::write() {
  for (GrowingTable* table : tables()) table->write();
  if (contacts_) contacts_->write();
  frames_written_ = frames_added_;
}

std::vector<core::ByteRange> FrameColumns::cut(hid_t file) {
  std::vector<core::ByteRange> unused;
  for (GrowingTable* table : tables()) table->cut(file, unused);
  if (contacts_) contacts_->cut(file, unused);
  return unused;
}

void FrameColumns::close() {
  for (GrowingTable* table : tables()) table->close();
  if (contacts_) contacts_->close();
}

}  // namespace pbmpi::io
