/// Selects which of a run's poses the page holds.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "io/run/run_data.h"

namespace pbmpi::io::html {

/// The part of a run that the replay shows: the first worlds, and every k-th recorded frame.
struct Selection {
  int num_worlds = 0;                ///< worlds 0 .. num_worlds - 1
  std::int64_t num_bodies = 0;       ///< bodies of these worlds: ids 0 .. num_bodies - 1
  std::vector<std::size_t> records;  ///< indices into RunData::position, ascending; last record included
  std::string note;                  ///< what was left out and why; empty if nothing was
};

/// Three bytes become 4 characters of the page; a pose is 7 single-precision numbers.
inline constexpr std::int64_t three_poses_bytes = std::int64_t{7} * 4 * 4;

/// An integer root attribute of the run; `absent` if the run does not have it.
std::int64_t integer_attribute_of(const RunData& run, const std::string& name, std::int64_t absent);

/// Bytes that this number of poses takes in the page.
constexpr std::int64_t pose_bytes(std::int64_t count) { return (three_poses_bytes * count + 2) / 3; }

/// Number of poses that fit into this number of bytes.
constexpr std::int64_t poses_in(std::int64_t bytes) { return 3 * bytes / three_poses_bytes; }

/// Frames beyond this number are thinned before worlds are left out: 20 s of simulated time at 30 Hz.
inline constexpr std::size_t preferred_records = 600;

/// The largest selection whose poses fit into `max_pose_bytes`. It has all worlds and frames if they fit;
/// else at most preferred_records frames of as many worlds as fit; else fewer frames of world 0, but at least
/// the last one.
Selection select_replay(const RunData& run, std::int64_t max_pose_bytes);

/// JSON of the selected poses and geoms, for io/html/data.js.
std::string replay_json(const RunData& run, const Selection& selection);

}  // namespace pbmpi::io::html
