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

Table read_table(hid_t file, const std::string& path, std::int64_t rows, int items) {
  const std::vector<double> values = read_doubles(file, path, rows, static_cast<hsize_t>(items));
  Table table;
  for (auto row = values.begin(); row != values.end(); row += items) table.emplace_back(row, row + items);
  return table;
}

/// Position and orientation of the bodies below `group`.
Motion read_motion(hid_t file, const std::string& group, std::int64_t num_recorded, std::int64_t num_bodies) {
  const auto bodies = static_cast<std::size_t>(num_bodies);
  const auto position = read_doubles(file, group + "/position/value", num_recorded, 3 * bodies);
  const auto orientation = read_doubles(file, group + "/orientation/value", num_recorded, 4 * bodies);
  Motion motion;
  for (std::size_t row = 0; row < static_cast<std::size_t>(num_recorded); ++row) {
    motion.position.push_back(to_vectors(&position[row * 3 * bodies], bodies));
    motion.orientation.push_back(to_quaternions(&orientation[row * 4 * bodies], bodies));
  }
  return motion;
}

EstimateData read_estimate(hid_t file, std::int64_t num_recorded, const RunData& run) {
  if (!has_object(file, "/estimate")) return {};
  return {read_motion(file, "/estimate", num_recorded, run.num_bodies),
          read_motion(file, "/particles/bodies", num_recorded, run.num_bodies),
          read_doubles(file, "/estimate/delivered", run.frames_committed, 1),
          read_doubles(file, "/estimate/precise", run.frames_committed, 1)};
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
    if (has_object(file, path) && !column.is_vector())
      run.observables[name] = read_table(file, path, run.frames_committed, run.num_worlds);
  }
}

void read_frames(hid_t file, RunData& run) {
  const std::int64_t rows = run.frames_committed;
  read_observables(file, run);
  run.frame_wall_s = read_doubles(file, "/timings/frame/wall", rows, 1);
  run.frame_measured = to_flags(read_integers(file, "/timings/frame/measured", rows));
  std::vector<std::string> phases(core::phase_names.begin(), core::phase_names.end());
  for (const char* column : {"useful", "messages", "bytes"}) phases.emplace_back(column);
  for (const std::string& phase : phases) {
    run.rank_times[phase] = read_table(file, "/timings/rank/" + phase, rows, run.num_ranks);
  }
  if (has_object(file, "/timings/rank/processor"))  // since 1.8
    run.rank_times["processor"] = read_table(file, "/timings/rank/processor", rows, run.num_ranks);
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
  run.num_bodies = static_cast<std::int64_t>(dims_of(file, "/particles/bodies/id").at(0));
  read_frames(file, run);
  run.estimate = read_estimate(file, run.frames_committed / record_every, run);
  read_events(file, run);
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
