/// A run and what went on from its checkpoints as one file.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace pbmpi::io {

struct JoinedRun {
  struct Part {
    std::string path;
    std::int64_t first_frame = 0, num_frames = 0;  ///< that the file has
    std::int64_t num_used = 0;                     ///< that come from it
    std::vector<std::string> differs;  ///< from the first part, in what does not matter for results
  };
  std::vector<Part> parts;  ///< in the order of their frames
  std::int64_t first_frame = 0, num_frames = 0;
  bool complete = false;
  std::string state_hash;             ///< empty: the run was cut off
  std::vector<std::string> left_out;  ///< tables that not all parts have
};

/// Writes the file `output`, which has all that the file of a run has that was never stopped. Frames that
/// several files have must be equal bit for bit but for what clocks have measured; the later file's are
/// taken. `common_only`: tables that not all files have are left out instead of refused. Throws
/// core::InputError: files that are not of one run, frames that are missing, an output that cannot be
/// written.
JoinedRun join_runs(const std::vector<std::string>& paths, const std::string& output, bool common_only);

}  // namespace pbmpi::io
