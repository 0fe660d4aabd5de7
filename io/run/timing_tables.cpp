/// Group /timings: seconds of frames and of ranks in their phases, and of islands and spaces if steps are
/// profiled.
#include "io/run/frame_table.h"

namespace pbmpi::io {
namespace {

void put_frame(const FrameSource& source, GrowingTable& row) {
  row.put(0, 0, source.frame.step);
  row.put(1, 0, source.frame.time_s);
  row.put(2, 0, static_cast<std::uint8_t>(source.frame.measured));
  row.put(3, 0, source.frame.wall_s);
  row.put(4, 0, static_cast<std::uint8_t>(source.frame.deadline_met));
}

std::vector<ColumnSpec> rank_columns() {
  std::vector<ColumnSpec> columns;
  columns.reserve(core::phase_names.size() + 4);
  for (const std::string_view phase : core::phase_names)
    columns.push_back({std::string(phase), H5T_NATIVE_DOUBLE, 1, "s"});
  columns.push_back({"useful", H5T_NATIVE_DOUBLE, 1, "s"});
  columns.push_back({"processor", H5T_NATIVE_DOUBLE, 1, "s"});
  columns.push_back({"messages", H5T_NATIVE_INT64});
  columns.push_back({"bytes", H5T_NATIVE_INT64, 1, "B"});
  return columns;
}

void put_rank(const FrameSource& source, GrowingTable& row) {
  const hsize_t rank = source.own_rank();
  for (std::size_t phase = 0; phase < core::num_phases; ++phase)
    row.put(phase, rank, source.frame.phases.seconds[phase]);
  row.put(core::num_phases, rank, source.frame.phases.useful_s());
  row.put(core::num_phases + 1, rank, source.frame.processor_s);
  row.put(core::num_phases + 2, rank, source.frame.traffic.messages);
  row.put(core::num_phases + 3, rank, source.frame.traffic.bytes);
}

/// The profile of a world, empty for one that has ended.
const stepping::StepProfile& profile_of(const stepping::LocalWorld& world) {
  static const stepping::StepProfile nothing;
  return world.profile != nullptr ? *world.profile : nothing;
}

void put_islands(const FrameSource& source, GrowingTable& row) {
  for (const stepping::LocalWorld& world : source.frame.worlds) {
    const hsize_t first = source.first_body(world);
    std::vector<stepping::IslandCost> at_body(world.state->position.size());
    for (const stepping::IslandCost& island : profile_of(world).islands) at_body[island.first_body] = island;
    for (std::size_t i = 0; i < at_body.size(); ++i) {
      row.put(0, first + i, at_body[i].bodies);
      row.put(1, first + i, at_body[i].contacts);
      row.put(2, first + i, at_body[i].rows);
      row.put(3, first + i, at_body[i].solve_s);
    }
  }
}

void put_spaces(const FrameSource& source, GrowingTable& row) {
  for (const stepping::LocalWorld& world : source.frame.worlds) {
    const stepping::StepProfile& profile = profile_of(world);
    const auto item = static_cast<hsize_t>(world.id);
    row.put(0, item, profile.cross_contacts);
    row.put(1, item, profile.collide_s);
    row.put(2, item, profile.collide_spaces_s);
  }
}

}  // namespace

std::vector<FrameTable> timing_tables(const OptionalColumns& optional) {
  std::vector<FrameTable> tables = {{"/timings/frame",
                                     {{"step", H5T_NATIVE_INT64},
                                      {"time", H5T_NATIVE_DOUBLE, 1, "s"},
                                      {"measured", H5T_NATIVE_UINT8},
                                      {"wall", H5T_NATIVE_DOUBLE, 1, "s"},
                                      {"deadline_met", H5T_NATIVE_UINT8}},
                                     Items::run,
                                     Rows::frames,
                                     put_frame},
                                    {"/timings/rank", rank_columns(), Items::ranks, Rows::frames, put_rank}};
  if (!optional.profile) return tables;
  tables.push_back({"/timings/island",
                    {{"bodies", H5T_NATIVE_INT32},
                     {"contacts", H5T_NATIVE_INT32},
                     {"rows", H5T_NATIVE_INT32},
                     {"solve", H5T_NATIVE_DOUBLE, 1, "s"}},
                    Items::bodies,
                    Rows::frames,
                    put_islands});
  tables.push_back({"/timings/space",
                    {{"cross_contacts", H5T_NATIVE_INT32},
                     {"collide", H5T_NATIVE_DOUBLE, 1, "s"},
                     {"collide_spaces", H5T_NATIVE_DOUBLE, 1, "s"}},
                    Items::worlds,
                    Rows::frames,
                    put_spaces});
  return tables;
}

}  // namespace pbmpi::io
