#include "io/run/frame_columns.h"
#include "io/run/run_file.h"
#include "io/setup/static_columns.h"

namespace pbmpi::io {

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

}  // namespace pbmpi::io
