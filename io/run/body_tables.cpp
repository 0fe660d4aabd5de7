/// Group /particles/bodies: motion of all bodies in the frames that are recorded.
#include "io/run/frame_table.h"

namespace pbmpi::io {
namespace {

void put_motion(const FrameSource& source, GrowingTable& row) {
  for (const stepping::LocalWorld& world : source.frame.worlds) {
    const model::State& state = *world.state;
    const hsize_t first = source.first_body(world);
    row.put(0, first, state.position.data(), state.position.size());
    row.put(1, first, state.orientation.data(), state.orientation.size());
    row.put(2, first, state.velocity.data(), state.velocity.size());
    row.put(3, first, state.angular_velocity.data(), state.angular_velocity.size());
  }
}

void put_step_and_time(const FrameSource& source, GrowingTable& row) {
  row.put(0, 0, source.frame.step);
  row.put(1, 0, source.frame.time_s);
}

}  // namespace

std::vector<FrameTable> body_tables() {
  return {{"/particles/bodies",
           {{"position/value", H5T_NATIVE_DOUBLE, 3, "m"},
            {"orientation/value", H5T_NATIVE_DOUBLE, 4, ""},
            {"velocity/value", H5T_NATIVE_DOUBLE, 3, "m s-1"},
            {"angular_velocity/value", H5T_NATIVE_DOUBLE, 3, "rad s-1"}},
           Items::bodies,
           Rows::recorded,
           put_motion},
          {"/particles/bodies/position",
           {{"step", H5T_NATIVE_INT64}, {"time", H5T_NATIVE_DOUBLE, 1, "s"}},
           Items::run,
           Rows::recorded,
           put_step_and_time}};
}

}  // namespace pbmpi::io
