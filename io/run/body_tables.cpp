/// Group /particles/bodies: motion of all bodies in the frames that are recorded.
#include "io/run/frame_table.h"

namespace pbmpi::io {
namespace {

void put_motion(const FrameSource& source, GrowingTable& row) {
  for (const stepping::LocalWorld& world : source.frame.worlds) {
    put_values(model::body_columns, *world.state, source.first_body(world), row);
  }
}

void put_step_and_time(const FrameSource& source, GrowingTable& row) {
  row.put(0, 0, source.frame.step);
  row.put(1, 0, source.frame.time_s);
}

}  // namespace

std::vector<ColumnSpec> value_columns(std::span<const model::BodyColumn> columns) {
  std::vector<ColumnSpec> specs;
  specs.reserve(columns.size());
  for (const model::BodyColumn& column : columns)
    specs.push_back({std::string(column.name) + "/value", H5T_NATIVE_DOUBLE, column.width(), column.unit});
  return specs;
}

void put_values(std::span<const model::BodyColumn> columns, const model::State& state, hsize_t first,
                GrowingTable& row) {
  for (std::size_t i = 0; i < columns.size(); ++i) row.put(i, first, columns[i].of(state));
}

std::vector<FrameTable> body_tables() {
  return {
      {"/particles/bodies", value_columns(model::body_columns), Items::bodies, Rows::recorded, put_motion},
      {"/particles/bodies/position",
       {{"step", H5T_NATIVE_INT64}, {"time", H5T_NATIVE_DOUBLE, 1, "s"}},
       Items::run,
       Rows::recorded,
       put_step_and_time}};
}

}  // namespace pbmpi::io
