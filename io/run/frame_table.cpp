#include "io/run/frame_table.h"

#include <map>

#include "io/hdf5/file_checksum.h"
#include "io/hdf5/read_columns.h"
#include "io/hdf5/rows.h"
#include "io/run/contact_rows.h"

namespace pbmpi::io {
namespace {

std::vector<Range> own_items(Items items, const FrameSource& source) {
  std::vector<Range> ranges;
  switch (items) {
    case Items::run:
      if (source.rank == 0) ranges.push_back({0, 1});
      break;
    case Items::ranks:
      ranges.push_back({source.own_rank(), 1});
      break;
    case Items::worlds:
      for (const stepping::LocalWorld& world : source.frame.worlds)
        append_range(ranges, static_cast<hsize_t>(world.id), 1);
      break;
    case Items::bodies:
      for (const stepping::LocalWorld& world : source.frame.worlds)
        append_range(ranges, source.first_body(world), world.state->position.size());
      break;
    case Items::joints:
      for (const stepping::LocalWorld& world : source.frame.worlds)
        append_range(ranges, source.first_joint(world), world.model->joints.size());
      break;
  }
  return ranges;
}

/// Throws unless every committed row matches its checksum.
void check_committed_rows(hid_t file, std::int64_t num_frames, std::int64_t num_recorded) {
  std::map<std::string, std::int64_t> rows;
  for (const FrameTable& table : all_frame_tables()) {
    const std::string path = row_checksum_path(table.group + "/" + table.columns.front().name);
    rows[path.substr(path.rfind('/') + 1)] = table.rows == Rows::frames ? num_frames : num_recorded;
  }
  rows["contacts.frame.first"] = num_frames;
  rows["events.frame"] = integer_attribute(file, "/events", "num_events");
  check_rows(file, [&](const std::string& name) {
    const auto found = rows.find(name);  // a newer layout may have other tables
    return found == rows.end() ? std::nullopt : std::optional(found->second);
  });
  check_contacts(file, read_contact_spans(file, num_frames));
}

}  // namespace

std::int64_t num_items(const FrameTable& table, const RunShape& shape) {
  switch (table.items) {
    case Items::run:
      return 0;
    case Items::ranks:
      return shape.num_ranks;
    case Items::worlds:
      return shape.num_worlds;
    case Items::bodies:
      return shape.num_bodies;
    case Items::joints:
      return shape.num_joints;
  }
  return 0;
}

std::size_t row_bytes(const FrameTable& table, const RunShape& shape) {
  const std::int64_t items = table.items == Items::run ? 1 : num_items(table, shape);
  return GrowingTable::row_bytes(table.columns, static_cast<hsize_t>(items));
}

void begin_row(const FrameTable& table, const FrameSource& source, GrowingTable& row) {
  row.begin_row(own_items(table.items, source));
}

std::vector<FrameTable> frame_tables(const OptionalColumns& optional) {
  std::vector<FrameTable> tables;
  // The largest optional table comes last: only space at the end of the file is freed when a run is cut.
  for (const auto& group : {body_tables(), observable_tables(optional), joint_tables(optional),
                            timing_tables(optional), estimate_tables(optional)}) {
    tables.insert(tables.end(), group.begin(), group.end());
  }
  return tables;
}

std::vector<FrameTable> frame_tables(const RunShape& shape) {
  std::vector<FrameTable> tables = frame_tables(shape.optional);
  if (shape.num_joints == 0) std::erase_if(tables, [](const auto& t) { return t.items == Items::joints; });
  return tables;
}

std::vector<FrameTable> all_frame_tables() {
  return frame_tables(OptionalColumns{.profile = true,
                                      .estimate = true,
                                      .residuals = true,
                                      .contacts = true,
                                      .breaks = true,
                                      .interest = true});
}

void check_run(hid_t file) {
  check_checksums(file);
  const std::int64_t num_frames = integer_attribute(file, "/", "frames_committed");
  const std::int64_t record_every = integer_attribute(file, "/", "record_every");
  if (num_frames < 0 || record_every < 1) throw core::RunError("impossible root attributes");
  check_committed_rows(file, num_frames, num_frames / record_every);
}

}  // namespace pbmpi::io
