#include <algorithm>
#include <utility>

#include "core/error.h"
#include "io/hdf5/file_checksum.h"
#include "io/hdf5/read_columns.h"
#include "io/hdf5/written_file.h"
#include "io/run/event_columns.h"
#include "io/run/frame_table.h"
#include "io/run/run_data.h"
#include "io/setup/world_result_rows.h"
#include "stepping/observable_table.h"

namespace pbmpi::io {
namespace {

using core::Pose;
using core::Quat;
using core::Vec3;

std::vector<int> to_ints(const std::vector<std::int64_t>& values) { return {values.begin(), values.end()}; }

std::vector<Vec3> to_vectors(const double* values, std::size_t count) {
  std::vector<Vec3> vectors;
  vectors.reserve(count);
  for (std::size_t i = 0; i < count; ++i, values += 3) vectors.emplace_back(values[0], values[1], values[2]);
  return vectors;
}

std::vector<Quat> to_quaternions(const double* values, std::size_t count) {
  std::vector<Quat> quaternions;
  quaternions.reserve(count);
  for (std::size_t i = 0; i < count; ++i, values += 4) {
    quaternions.push_back({values[0], values[1], values[2], values[3]});
  }
  return quaternions;
}

std::vector<Pose> read_poses(hid_t file, const std::string& position, const std::string& orientation,
                             std::int64_t count) {
  const auto positions =
      to_vectors(read_doubles(file, position, count, 3).data(), static_cast<std::size_t>(count));
  const auto turns =
      to_quaternions(read_doubles(file, orientation, count, 4).data(), static_cast<std::size_t>(count));
  std::vector<Pose> poses;
  for (std::size_t i = 0; i < positions.size(); ++i) poses.push_back({positions[i], turns[i]});
  return poses;
}

Table read_table(hid_t file, const std::string& path, std::int64_t rows, int items) {
  const std::vector<double> values = read_doubles(file, path, rows, static_cast<hsize_t>(items));
  Table table;
  for (auto row = values.begin(); row != values.end(); row += items) table.emplace_back(row, row + items);
  return table;
}

VectorTable read_vector_table(hid_t file, const std::string& path, std::int64_t rows, int items) {
  const auto count = static_cast<std::size_t>(items);
  const std::vector<double> values = read_doubles(file, path, rows, 3 * count);
  VectorTable table;
  for (std::size_t row = 0; row < static_cast<std::size_t>(rows); ++row)
    table.push_back(to_vectors(&values[row * 3 * count], count));
  return table;
}

/// Throws unless all values lie in [0, count).
void require_indices(const std::vector<std::int64_t>& values, std::int64_t count, const std::string& path) {
  for (const std::int64_t value : values) {
    if (value < 0 || value >= count)
      throw core::RunError(path + " has " + std::to_string(value) + ", of " + std::to_string(count));
  }
}

BodyTable read_bodies(hid_t file, int num_worlds) {
  const std::string group = "/particles/bodies/";
  BodyTable bodies;
  bodies.id = read_integers(file, group + "id");
  const auto count = static_cast<std::int64_t>(bodies.id.size());
  const auto world = read_integers(file, group + "world", count);
  const auto local_body = read_integers(file, group + "local_body", count);
  require_indices(world, num_worlds, group + "world");
  require_indices(local_body, count, group + "local_body");
  for (std::int64_t id = 0; id < count; ++id) {
    if (bodies.id[static_cast<std::size_t>(id)] != id) throw core::RunError(group + "id is not 0, 1, 2 ...");
  }
  bodies.world = to_ints(world);
  bodies.local_body = to_ints(local_body);
  bodies.name = read_texts(file, group + "name", count);
  bodies.kind = read_texts(file, group + "kind", count);
  bodies.actor = read_texts(file, group + "actor", count);
  bodies.mass_kg = read_doubles(file, group + "mass", count, 1);
  bodies.initial = read_poses(file, group + "initial_position", group + "initial_orientation", count);
  return bodies;
}

std::vector<GeomRow> read_geoms(hid_t file, std::int64_t num_bodies, int num_worlds) {
  const auto world = read_integers(file, "/geoms/world");
  require_indices(world, num_worlds, "/geoms/world");
  const auto count = static_cast<std::int64_t>(world.size());
  const auto body = read_integers(file, "/geoms/body", count);
  const auto kind = read_texts(file, "/geoms/kind", count);
  const auto shape = read_texts(file, "/geoms/shape", count);
  const auto size = read_doubles(file, "/geoms/size", count, 3);
  const auto local = read_poses(file, "/geoms/position", "/geoms/orientation", count);
  std::vector<GeomRow> geoms;
  for (std::size_t i = 0; i < world.size(); ++i) {
    if (body[i] < -1 || body[i] >= num_bodies) throw core::RunError("/geoms/body points to no body");
    geoms.push_back({static_cast<int>(world[i]),
                     body[i],
                     kind[i],
                     shape[i],
                     {size[3 * i], size[3 * i + 1], size[3 * i + 2]},
                     local[i]});
  }
  return geoms;
}

/// Position [P][N] and orientation [P][N] below `group`.
void read_poses(hid_t file, const std::string& group, std::int64_t num_recorded, std::size_t bodies,
                std::vector<std::vector<Vec3>>& positions, std::vector<std::vector<Quat>>& orientations) {
  const auto position = read_doubles(file, group + "/position/value", num_recorded, 3 * bodies);
  const auto orientation = read_doubles(file, group + "/orientation/value", num_recorded, 4 * bodies);
  for (std::size_t row = 0; row < static_cast<std::size_t>(num_recorded); ++row) {
    positions.push_back(to_vectors(&position[row * 3 * bodies], bodies));
    orientations.push_back(to_quaternions(&orientation[row * 4 * bodies], bodies));
  }
}

void read_motion(hid_t file, std::int64_t num_recorded, RunData& run) {
  const std::string group = "/particles/bodies";
  run.recorded_step = read_integers(file, group + "/position/step", num_recorded);
  run.recorded_time_s = read_doubles(file, group + "/position/time", num_recorded, 1);
  read_poses(file, group, num_recorded, run.bodies.id.size(), run.position, run.orientation);
}

void read_estimate(hid_t file, std::int64_t num_recorded, RunData& run) {
  if (!has_object(file, "/estimate")) return;
  read_poses(file, "/estimate", num_recorded, run.bodies.id.size(), run.estimate.position,
             run.estimate.orientation);
  run.estimate.delivered_s = read_doubles(file, "/estimate/delivered", run.frames_committed, 1);
  run.estimate.precise_s = read_doubles(file, "/estimate/precise", run.frames_committed, 1);
}

std::vector<bool> to_flags(const std::vector<std::int64_t>& values) {
  std::vector<bool> flags;
  flags.reserve(values.size());
  for (const std::int64_t value : values) flags.push_back(value != 0);
  return flags;
}

/// A file of an older layout has no column for observables that were not measured then.
void read_observables(hid_t file, RunData& run) {
  for (const stepping::WorldColumn& column : stepping::world_observables) {
    const std::string name(column.name), path = "/observables/world/" + name;
    if (!has_object(file, path)) continue;
    if (column.is_vector()) {
      run.vector_observables[name] = read_vector_table(file, path, run.frames_committed, run.num_worlds);
    } else {
      run.observables[name] = read_table(file, path, run.frames_committed, run.num_worlds);
    }
  }
}

void read_frames(hid_t file, RunData& run) {
  const std::int64_t rows = run.frames_committed;
  read_observables(file, run);
  run.frame_wall_s = read_doubles(file, "/timings/frame/wall", rows, 1);
  run.frame_measured = to_flags(read_integers(file, "/timings/frame/measured", rows));
  run.deadline_met = to_flags(read_integers(file, "/timings/frame/deadline_met", rows));
  std::vector<std::string> phases(core::phase_names.begin(), core::phase_names.end());
  for (const char* column : {"useful", "messages", "bytes"}) phases.emplace_back(column);
  for (const std::string& phase : phases) {
    run.rank_times[phase] = read_table(file, "/timings/rank/" + phase, rows, run.num_ranks);
  }
}

/// Only a run with --record islands has profiles.
void read_profiles(hid_t file, RunData& run) {
  if (H5Lexists(file, "/timings/island", H5P_DEFAULT) <= 0) return;
  const std::int64_t rows = run.frames_committed;
  const std::size_t bodies = run.bodies.id.size();
  const auto column = [&](const char* name) {
    return read_doubles(file, std::string("/timings/island/") + name, rows, bodies);
  };
  const std::vector<double> size = column("bodies"), contacts = column("contacts"),
                            row_count = column("rows"), solve = column("solve");
  for (std::size_t frame = 0; frame < static_cast<std::size_t>(rows); ++frame) {
    std::vector<IslandRow>& islands = run.islands.emplace_back();
    for (std::size_t body = 0; body < bodies; ++body) {
      const std::size_t i = frame * bodies + body;
      if (size[i] == 0) continue;
      islands.push_back({static_cast<std::int64_t>(body), static_cast<int>(size[i]),
                         static_cast<int>(contacts[i]), static_cast<int>(row_count[i]), solve[i]});
    }
  }
  for (const char* name : {"cross_contacts", "collide", "collide_spaces"}) {
    run.space_times[name] = read_table(file, std::string("/timings/space/") + name, rows, run.num_worlds);
  }
}

RunData read_all(hid_t file) {
  check_run(file);
  RunData run;
  run.attributes = attributes_as_text(file, "/");
  run.parameters = scalars_as_text(file, "/parameters");
  run.complete = integer_attribute(file, "/", "complete") != 0;
  run.frames_committed = integer_attribute(file, "/", "frames_committed");
  const std::int64_t record_every = integer_attribute(file, "/", "record_every");
  run.hosts = read_texts(file, "/ranks/host");
  run.num_ranks = static_cast<int>(run.hosts.size());
  const std::vector<hsize_t> table = dims_of(file, "/observables/world/contacts");
  if (table.size() != 2) throw core::RunError("/observables/world/contacts is not a table");
  if (table[1] < 1 || !std::in_range<int>(table[1]))
    throw core::RunError("/observables/world/contacts has an impossible number of worlds");
  run.num_worlds = static_cast<int>(table[1]);
  run.bodies = read_bodies(file, run.num_worlds);
  run.geoms = read_geoms(file, static_cast<std::int64_t>(run.bodies.id.size()), run.num_worlds);
  read_motion(file, run.frames_committed / record_every, run);
  read_frames(file, run);
  read_profiles(file, run);
  read_estimate(file, run.frames_committed / record_every, run);
  read_events(file, run);
  run.world_id = read_world_ids(file, run.num_worlds);
  run.world_results = read_world_results(file);
  if (!run.world_results.empty() && std::ssize(run.world_results) != run.num_worlds)
    throw core::RunError("/world_results has not a row for each world");
  return run;
}

/// read(file) of the run's file, with a message that names it.
template <class Read>
auto read_from(const std::string& path, Read read) {
  const File file = open_run(path);
  try {
    return read(file.id());
  } catch (const core::RunError& error) {
    throw core::InputError(path + ": " + error.what() + "; the file is damaged or incomplete");
  }
}

}  // namespace

RunData read_run(const std::string& path) { return read_from(path, read_all); }

void require_sound_run(const std::string& path) { read_from(path, check_run); }

void store_checksums(const std::string& path) {
  auto file = WrittenFile::open(path);
  store_row_checksums(file.id());
  store_fixed_checksum(file.id());
  store_end_checksum(file.id());
  file.close();
}

}  // namespace pbmpi::io
