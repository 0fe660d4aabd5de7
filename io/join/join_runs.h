/// Joins a run and its continuations from checkpoints into one file.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace pbmpi::io {

struct JoinedRun {
  struct Part {
    std::string path;
    std::int64_t first_frame = 0, num_frames = 0;  ///< of the file
    std::int64_t num_used = 0;                     ///< frames taken from the file
    std::vector<std::string> differs;  ///< from the first part, in what does not matter for results
  };
  std::vector<Part> parts;  ///< in the order of their frames
  std::int64_t first_frame = 0, num_frames = 0;
  bool complete = false;
  std::string state_hash;             ///< empty: the run was cut off
  std::vector<std::string> left_out;  ///< tables that not all parts have
};

/// Writes the file `output`, which holds all that the file of an uninterrupted run holds. Frames that several
/// files have must be equal bit for bit, except what clocks have measured; the later file's frames are taken.
/// `common_only`: tables that not all files have are left out instead of refused. Throws core::InputError for
/// files that are not of one run, frames that are missing, or an output that cannot be created;
/// core::RunError if a write fails.
JoinedRun join_runs(const std::vector<std::string>& paths, const std::string& output, bool common_only);

}  // namespace pbmpi::io
