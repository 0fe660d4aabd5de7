/// What the summary of a run needs of its HDF5 file.
#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "core/clock.h"
#include "core/vector.h"
#include "io/setup/world_results.h"
#include "model/model.h"
#include "stepping/run_event.h"

namespace pbmpi::io {

/// Per-frame columns of one observable: [T][W], frame first.
using Table = std::vector<std::vector<double>>;

/// The poses of the bodies in the recorded frames.
struct Motion {
  std::vector<std::vector<core::Vec3>> position;     ///< [P][N] m
  std::vector<std::vector<core::Quat>> orientation;  ///< [P][N]
};

/// The part of a run's data that FEEC adds. Empty without it.
struct EstimateData {
  Motion estimated, precise;
  std::vector<double> delivered_s;  ///< [T] start of the frame until root had the estimate
  std::vector<double> precise_s;    ///< [T] start of the frame until root had the precise result
};

struct RunData {
  std::map<std::string, std::string> attributes;  ///< of the root, as text
  std::map<std::string, std::string> parameters;  ///< of /parameters, as text
  bool complete = false;
  std::int64_t frames_committed = 0;
  int num_worlds = 0;
  int num_ranks = 0;
  std::int64_t num_bodies = 0;
  /// Columns of stepping::world_observables that are numbers and that the file has: name -> [T][W].
  std::map<std::string, Table> observables;
  std::vector<double> frame_wall_s;         ///< [T]
  std::vector<bool> frame_measured;         ///< [T]
  std::map<std::string, Table> rank_times;  ///< phase, "useful", "processor" -> [T][R] s; "messages", "bytes"
  EstimateData estimate;
  std::vector<std::string> hosts;          ///< [R]
  std::vector<stepping::RunEvent> events;  ///< events that have a row in the file, in order of arrival
  std::map<std::string, std::int64_t> num_events;  ///< kind -> number, those without a row included
  std::int64_t worlds_moved = 0;                   ///< in all rebalances: worlds, or spaces
  std::vector<WorldResult> world_results;          ///< [W]; empty if the run did not come to its end
};

/// Reads the committed frames of a pbmpi-run file (also one that was cut off by a kill). Throws
/// core::InputError if the file is missing, not HDF5, of another file type, or of a newer major version.
RunData read_run(const std::string& path);
/// Throws core::InputError as read_run() does, also if what is committed does not match its checksums.
void require_sound_run(const std::string& path);
/// Stores all checksums of a run's file that another program has made. Throws core::RunError.
void store_checksums(const std::string& path);

}  // namespace pbmpi::io
