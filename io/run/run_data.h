/// A run read back from its HDF5 file.
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

struct BodyTable {
  std::vector<std::int64_t> id;     ///< [N] 0 .. N-1 in (world, body) order
  std::vector<int> world;           ///< [N]
  std::vector<int> local_body;      ///< [N] index in its world
  std::vector<std::string> name;    ///< [N]
  std::vector<std::string> kind;    ///< [N] actor kind, e.g. "human"
  std::vector<std::string> actor;   ///< [N] actor name, e.g. "human1"
  std::vector<double> mass_kg;      ///< [N]
  std::vector<core::Pose> initial;  ///< [N]
};

/// One geom of one world, for the replay.
struct GeomRow {
  int world = 0;
  std::int64_t body = -1;  ///< global body id; -1 = static
  std::string kind;        ///< actor kind
  std::string shape;
  std::array<double, 3> size{};
  core::Pose local;
};

/// One island of a profiled step.
struct IslandRow {
  std::int64_t first_body = 0;  ///< global id of its lowest body
  int bodies = 0, contacts = 0, rows = 0;
  double solve_s = 0;  ///< solved alone
};

/// Per-frame columns of one observable: [T][W], frame first.
using Table = std::vector<std::vector<double>>;
using VectorTable = std::vector<std::vector<core::Vec3>>;

/// The part of a run's data that FEEC adds. Empty without it.
struct EstimateData {
  std::vector<std::vector<core::Vec3>> position;     ///< [P][N] m
  std::vector<std::vector<core::Quat>> orientation;  ///< [P][N]
  std::vector<double> delivered_s;                   ///< [T] start of the frame until root had the estimate
  std::vector<double> precise_s;  ///< [T] start of the frame until root had the precise result
};

struct RunData {
  std::map<std::string, std::string> attributes;  ///< of the root, as text
  std::map<std::string, std::string> parameters;  ///< of /parameters, as text
  bool complete = false;
  std::int64_t frames_committed = 0;
  int num_worlds = 0;
  int num_ranks = 0;
  BodyTable bodies;
  std::vector<GeomRow> geoms;
  std::vector<std::int64_t> recorded_step;           ///< [P] steps at which bodies were stored
  std::vector<double> recorded_time_s;               ///< [P]
  std::vector<std::vector<core::Vec3>> position;     ///< [P][N] m
  std::vector<std::vector<core::Quat>> orientation;  ///< [P][N]
  /// Columns of stepping::world_observables that the file has: name -> [T][W].
  std::map<std::string, Table> observables;
  std::map<std::string, VectorTable> vector_observables;
  std::vector<double> frame_wall_s;             ///< [T]
  std::vector<bool> frame_measured;             ///< [T]
  std::vector<bool> deadline_met;               ///< [T]
  std::map<std::string, Table> rank_times;      ///< phase, "useful" -> [T][R] s; "messages", "bytes"
  std::vector<std::vector<IslandRow>> islands;  ///< [T] of all worlds; empty unless the run recorded them
  std::map<std::string, Table> space_times;     ///< cross_contacts, collide, collide_spaces; as for islands
  EstimateData estimate;
  std::vector<std::string> hosts;          ///< [R]
  std::vector<stepping::RunEvent> events;  ///< events that have a row in the file, in order of arrival
  std::map<std::string, std::int64_t> num_events;  ///< kind -> number, those without a row included
  std::int64_t worlds_moved = 0;                   ///< in all rebalances: worlds, or spaces
  std::vector<std::int64_t> world_id;              ///< [W] numbers of the worlds in their ensemble
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
