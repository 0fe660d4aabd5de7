#include "io/html/replay_data.h"

#include <algorithm>
#include <charconv>
#include <nlohmann/json.hpp>

#include "io/html/base64.h"
#include "io/html/escape.h"
#include "model/names.h"

namespace pbmpi::io::html {
namespace {

using nlohmann::json;

/// The number of bodies in worlds 0 .. num_worlds - 1. Bodies are in (world, body) order.
std::int64_t bodies_before(const RunData& run, int num_worlds) {
  const auto& world = run.bodies.world;
  return std::lower_bound(world.begin(), world.end(), num_worlds) - world.begin();
}

/// Every k-th record, aligned so that the last one is included.
std::vector<std::size_t> every_kth(std::size_t count, std::size_t k) {
  std::vector<std::size_t> records;
  for (std::size_t i = (count + k - 1) % k; i < count; i += k) records.push_back(i);
  return records;
}

/// At most `most` of `count` records, as many as a fixed stride allows.
std::vector<std::size_t> at_most(std::size_t count, std::size_t most) {
  return every_kth(count, std::max<std::size_t>(1, (count + most - 1) / std::max<std::size_t>(1, most)));
}

std::string describe(const RunData& run, const Selection& selection) {
  std::string what;
  if (selection.num_worlds < run.num_worlds) {
    what = "the first " + std::to_string(selection.num_worlds) + " of " + std::to_string(run.num_worlds) +
           " worlds";
  }
  if (selection.records.size() < run.position.size()) {
    if (!what.empty()) what += " and ";
    what += std::to_string(selection.records.size()) + " of " + std::to_string(run.position.size()) +
            " recorded frames";
  }
  return what.empty() ? what
                      : "To keep this page small, the replay shows " + what + ". The run's file holds all.";
}

void append(std::vector<float>& numbers, const core::Vec3& v) {
  for (int i = 0; i < 3; ++i) numbers.push_back(static_cast<float>(v[i]));
}

void append(std::vector<float>& numbers, const core::Quat& q) {
  for (double c : {q.w, q.x, q.y, q.z}) numbers.push_back(static_cast<float>(c));
}

/// Positions [F][N][3] and orientations [F][N][4]; frame 0 is the initial pose.
void add_poses(json& replay, const RunData& run, const Selection& selection) {
  const auto num_bodies = static_cast<std::size_t>(selection.num_bodies);
  std::vector<float> position, orientation;
  position.reserve((selection.records.size() + 1) * num_bodies * 3);
  orientation.reserve((selection.records.size() + 1) * num_bodies * 4);
  for (std::size_t body = 0; body < num_bodies; ++body) {
    append(position, run.bodies.initial[body].position);
    append(orientation, run.bodies.initial[body].orientation);
  }
  for (std::size_t record : selection.records) {
    for (std::size_t body = 0; body < num_bodies; ++body) {
      append(position, run.position[record][body]);
      append(orientation, run.orientation[record][body]);
    }
  }
  replay["position"] = base64_of(position);
  replay["orientation"] = base64_of(orientation);
}

/// Frames are numbered from the start of the simulation, whose pose is that of frame 0.
void add_times(json& replay, const RunData& run, const Selection& selection) {
  const std::int64_t first = integer_attribute_of(run, "first_frame", 0);
  const std::int64_t every = integer_attribute_of(run, "record_every", 1);
  std::vector<double> time_s{0};
  std::vector<std::int64_t> step{0}, number{0};
  for (std::size_t record : selection.records) {
    time_s.push_back(run.recorded_time_s[record]);
    step.push_back(run.recorded_step[record]);
    number.push_back(first + every * static_cast<std::int64_t>(record + 1));
  }
  replay["number"] = number;
  replay["time_s"] = time_s;
  replay["step"] = step;
}

/// One column per property; `local` is [G][7]: position, then orientation. An unknown kind, from a file of a
/// newer minor version, counts as prop; a geom of unknown shape is not drawn.
void add_geoms(json& replay, const RunData& run, const Selection& selection) {
  std::vector<std::uint8_t> kind, shape;
  std::vector<std::int32_t> world, body;
  std::vector<float> size, local;
  for (const GeomRow& geom : run.geoms) {
    const auto known_shape = model::enum_from_name<model::Shape>(geom.shape, model::shape_names);
    if (geom.world >= selection.num_worlds || !known_shape) continue;
    const auto known_kind = model::enum_from_name<model::ActorKind>(geom.kind, model::actor_kind_names);
    kind.push_back(static_cast<std::uint8_t>(known_kind.value_or(model::ActorKind::prop)));
    shape.push_back(static_cast<std::uint8_t>(*known_shape));
    world.push_back(geom.world);
    body.push_back(static_cast<std::int32_t>(geom.body));
    for (double s : geom.size) size.push_back(static_cast<float>(s));
    append(local, geom.local.position);
    append(local, geom.local.orientation);
  }
  replay["geoms"] = {{"kind", base64_of(kind)}, {"shape", base64_of(shape)}, {"world", base64_of(world)},
                     {"body", base64_of(body)}, {"size", base64_of(size)},   {"local", base64_of(local)}};
  replay["kind_names"] = model::actor_kind_names;
  replay["shape_names"] = model::shape_names;
}

}  // namespace

std::int64_t integer_attribute_of(const RunData& run, const std::string& name, std::int64_t absent) {
  const auto found = run.attributes.find(name);
  std::int64_t value = absent;
  if (found != run.attributes.end()) {
    const char* const begin = found->second.data();
    std::from_chars(begin, begin + found->second.size(), value);
  }
  return value;
}

Selection select_replay(const RunData& run, std::int64_t max_pose_bytes) {
  const std::size_t num_records = run.position.size();
  const std::int64_t most = poses_in(max_pose_bytes);
  // The initial pose counts as one more frame, whatever is selected.
  const auto fits = [most](std::int64_t bodies, std::size_t records) {
    return bodies * static_cast<std::int64_t>(records + 1) <= most;
  };
  Selection selection{run.num_worlds, bodies_before(run, run.num_worlds), every_kth(num_records, 1), ""};
  if (!fits(selection.num_bodies, num_records)) {
    selection.records = at_most(num_records, preferred_records);
    while (selection.num_worlds > 1 && !fits(selection.num_bodies, selection.records.size())) {
      selection.num_bodies = bodies_before(run, --selection.num_worlds);
    }
    if (!fits(selection.num_bodies, selection.records.size())) {
      const std::int64_t frames = most / selection.num_bodies - 1;
      selection.records = at_most(num_records, static_cast<std::size_t>(std::max<std::int64_t>(1, frames)));
    }
  }
  selection.note = describe(run, selection);
  return selection;
}

std::string replay_json(const RunData& run, const Selection& selection) {
  json replay;
  replay["note"] = selection.note;
  replay["num_worlds"] = selection.num_worlds;
  replay["num_bodies"] = selection.num_bodies;
  const auto bodies = static_cast<std::ptrdiff_t>(selection.num_bodies);
  replay["body_names"] = std::vector(run.bodies.name.begin(), run.bodies.name.begin() + bodies);
  replay["body_world"] =
      base64_of(std::vector<std::int32_t>(run.bodies.world.begin(), run.bodies.world.begin() + bodies));
  add_times(replay, run, selection);
  add_poses(replay, run, selection);
  add_geoms(replay, run, selection);
  return dump(replay);
}

}  // namespace pbmpi::io::html
