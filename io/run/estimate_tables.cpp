/// Group /estimate: what FEEC delivered before the precise result.
#include "io/run/frame_table.h"

namespace pbmpi::io {
namespace {

const stepping::EstimateRecord& estimate_of(const FrameSource& source) {
  core::require_invariant(source.frame.estimate != nullptr,
                          "a frame has the estimate that its file has room for");
  return *source.frame.estimate;
}

void put_times(const FrameSource& source, GrowingTable& row) {
  row.put(0, 0, estimate_of(source).delivered_s);
  row.put(1, 0, source.frame.wall_s);
}

void put_ranks(const FrameSource& source, GrowingTable& row) {
  row.put(0, source.own_rank(), estimate_of(source).compute_s);
}

void put_poses(const FrameSource& source, GrowingTable& row) {
  for (const stepping::LocalWorld& world : estimate_of(source).worlds) {
    const hsize_t first = source.first_body(world);
    put_values(model::pose_columns, *world.state, first, row);
  }
}

}  // namespace

std::vector<FrameTable> estimate_tables(const OptionalColumns& optional) {
  if (!optional.estimate) return {};
  return {{"/estimate",
           {{"delivered", H5T_NATIVE_DOUBLE, 1, "s"}, {"precise", H5T_NATIVE_DOUBLE, 1, "s"}},
           Items::run,
           Rows::frames,
           put_times},
          {"/estimate", {{"compute", H5T_NATIVE_DOUBLE, 1, "s"}}, Items::ranks, Rows::frames, put_ranks},
          {"/estimate", value_columns(model::pose_columns), Items::bodies, Rows::recorded, put_poses}};
}

}  // namespace pbmpi::io
