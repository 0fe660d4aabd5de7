#include "whole_run.h"

#include "io/hdf5/read_columns.h"

namespace pbmpi::io::test {
namespace {

using core::Pose;
using core::Quat;
using core::Vec3;

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

BodyTable read_bodies(hid_t file) {
  const std::string group = "/particles/bodies/";
  BodyTable bodies;
  bodies.id = read_integers(file, group + "id");
  const auto count = static_cast<std::int64_t>(bodies.id.size());
  const auto world = read_integers(file, group + "world", count);
  const auto local_body = read_integers(file, group + "local_body", count);
  bodies.world.assign(world.begin(), world.end());
  bodies.local_body.assign(local_body.begin(), local_body.end());
  bodies.name = read_texts(file, group + "name", count);
  bodies.kind = read_texts(file, group + "kind", count);
  bodies.actor = read_texts(file, group + "actor", count);
  bodies.mass_kg = read_doubles(file, group + "mass", count, 1);
  bodies.initial = read_poses(file, group + "initial_position", group + "initial_orientation", count);
  return bodies;
}

std::vector<GeomRow> read_geoms(hid_t file) {
  const auto world = read_integers(file, "/geoms/world");
  const auto count = static_cast<std::int64_t>(world.size());
  const auto body = read_integers(file, "/geoms/body", count);
  const auto kind = read_texts(file, "/geoms/kind", count);
  const auto shape = read_texts(file, "/geoms/shape", count);
  const auto size = read_doubles(file, "/geoms/size", count, 3);
  const auto local = read_poses(file, "/geoms/position", "/geoms/orientation", count);
  std::vector<GeomRow> geoms;
  for (std::size_t i = 0; i < world.size(); ++i) {
    geoms.push_back({static_cast<int>(world[i]),
                     body[i],
                     kind[i],
                     shape[i],
                     {size[3 * i], size[3 * i + 1], size[3 * i + 2]},
                     local[i]});
  }
  return geoms;
}

/// Only a run with --record islands has profiles.
void read_profiles(hid_t file, WholeRun& run) {
  if (!has_object(file, "/timings/island")) return;
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
  for (const char* name : {"cross_contacts", "collide_spaces"}) {
    run.space_times[name] = read_table(file, std::string("/timings/space/") + name, rows, run.num_worlds);
  }
}

void read_motion(hid_t file, std::int64_t num_recorded, WholeRun& run) {
  const std::string group = "/particles/bodies/";
  const std::size_t bodies = run.bodies.id.size();
  run.recorded_step = read_integers(file, group + "position/step", num_recorded);
  const auto position = read_doubles(file, group + "position/value", num_recorded, 3 * bodies);
  const auto orientation = read_doubles(file, group + "orientation/value", num_recorded, 4 * bodies);
  for (std::size_t row = 0; row < static_cast<std::size_t>(num_recorded); ++row) {
    run.position.push_back(to_vectors(&position[row * 3 * bodies], bodies));
    run.orientation.push_back(to_quaternions(&orientation[row * 4 * bodies], bodies));
  }
}

}  // namespace

WholeRun read_whole_run(const std::string& path) {
  WholeRun run;
  static_cast<RunData&>(run) = read_run(path);
  const File open = open_run(path);
  const hid_t file = open.id();
  run.bodies = read_bodies(file);
  run.geoms = read_geoms(file);
  read_motion(file, run.frames_committed / integer_attribute(file, "/", "record_every"), run);
  for (const char* name : {"linear_momentum", "angular_momentum"})
    run.vector_observables[name] = read_vector_table(file, std::string("/observables/world/") + name,
                                                     run.frames_committed, run.num_worlds);
  for (const std::int64_t met : read_integers(file, "/timings/frame/deadline_met", run.frames_committed))
    run.deadline_met.push_back(met != 0);
  read_profiles(file, run);
  return run;
}

}  // namespace pbmpi::io::test
