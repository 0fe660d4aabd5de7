/// All of a run's file, for tests: what the programs leave to Python, too.
#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "core/vector.h"
#include "io/run/run_data.h"

namespace pbmpi::io::test {

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

using VectorTable = std::vector<std::vector<core::Vec3>>;

struct WholeRun : RunData {
  BodyTable bodies;
  std::vector<GeomRow> geoms;
  std::vector<std::int64_t> recorded_step;           ///< [P] steps at which bodies were stored
  std::vector<std::vector<core::Vec3>> position;     ///< [P][N] m
  std::vector<std::vector<core::Quat>> orientation;  ///< [P][N]
  std::map<std::string, VectorTable> vector_observables;
  std::vector<bool> deadline_met;               ///< [T]
  std::vector<std::vector<IslandRow>> islands;  ///< [T] of all worlds; empty unless the run recorded them
  std::map<std::string, Table> space_times;     ///< cross_contacts, collide_spaces; as for islands
};

/// Throws as read_run() does.
WholeRun read_whole_run(const std::string& path);

}  // namespace pbmpi::io::test
