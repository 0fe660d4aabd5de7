#include "io/join/run_outline.h"

#include "core/error.h"
#include "io/hdf5/read_columns.h"
#include "io/run/frame_table.h"

namespace pbmpi::io {
namespace {

std::vector<FrameNumber> read_frames(hid_t file, std::int64_t num_frames, std::int64_t first_frame) {
  const std::vector<std::int64_t> steps = read_integers(file, "/timings/frame/step", num_frames);
  std::vector<FrameNumber> frames;
  frames.reserve(steps.size());
  for (const std::int64_t step : steps) frames.push_back({first_frame + std::ssize(frames), step});
  return frames;
}

}  // namespace

RunOutline read_outline(const std::string& path) {
  const File run_file = open_run(path);
  const hid_t file = run_file.id();
  try {
    check_run(file);
    RunOutline run{.attributes = attributes_as_text(file, "/"),
                   .parameters = scalars_as_text(file, "/parameters"),
                   .hosts = read_texts(file, "/ranks/host"),
                   .frames = {},
                   .record_every = integer_attribute(file, "/", "record_every")};
    const bool is_resumed = run.attributes.contains("first_frame");
    run.frames = read_frames(file, integer_attribute(file, "/", "frames_committed"),
                             is_resumed ? integer_attribute(file, "/", "first_frame") : 0);
    return run;
  } catch (const core::RunError& error) {
    throw core::InputError(path + ": " + error.what() + "; the file is damaged or incomplete");
  }
}

}  // namespace pbmpi::io
