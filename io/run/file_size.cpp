#include "io/run/frame_columns.h"
#include "io/run/run_file.h"

namespace pbmpi::io {

std::int64_t estimate_file_bytes(std::int64_t num_bodies, int num_worlds, int num_ranks,
                                 std::int64_t num_frames, int record_every, const OptionalColumns& optional) {
  const RunShape shape{num_bodies, num_worlds, num_ranks, num_frames, record_every, optional, 0};
  const FrameBytes frame = frame_bytes(shape);
  // A body's row with names of usual length, and its one geom; a world's static geom; a rank's host.
  constexpr std::int64_t body_bytes = 160 + 112, world_bytes = 112, rank_bytes = 40;
  // Object headers and group tables of about 90 objects, and some parameters.
  constexpr std::int64_t metadata_bytes = std::int64_t{128} * 1024;
  return num_frames * static_cast<std::int64_t>(frame.every_frame) +
         shape.num_recorded() * static_cast<std::int64_t>(frame.recorded) + num_bodies * body_bytes +
         num_worlds * world_bytes + num_ranks * rank_bytes +
         static_cast<std::int64_t>(EventColumns::bytes()) + metadata_bytes;
}

}  // namespace pbmpi::io
