#include "page_sample.h"

#include <cmath>

namespace pbmpi::io::html {
namespace {

using core::Pose;
using core::Quat;
using core::Vec3;

Quat turn(double angle, const Vec3& axis) {
  return Quat::from_eigen(Eigen::Quaterniond(Eigen::AngleAxisd(angle, axis.normalized())));
}

/// Builds one world after the other into a run.
class Builder {
 public:
  explicit Builder(RunData& run) : run_(run) {}

  void begin_world(int world) {
    world_ = world;
    local_body_ = 0;
    run_.geoms.push_back({world_, -1, "ground", "plane", {0, 0, 0}, {}});
    run_.geoms.push_back(
        {world_, -1, "ramp", "box", {3, 1.6, 0.2}, {Vec3(1, 3.2, 0.4), turn(-0.26, Vec3(0, 1, 0))}});
  }

  void body(const std::string& actor, const std::string& kind, const std::string& part, const Pose& pose,
            const std::string& shape, const std::array<double, 3>& size) {
    BodyTable& bodies = run_.bodies;
    const auto id = static_cast<std::int64_t>(bodies.id.size());
    bodies.id.push_back(id);
    bodies.world.push_back(world_);
    bodies.local_body.push_back(local_body_++);
    bodies.name.push_back(actor + "." + part);
    bodies.kind.push_back(kind);
    bodies.actor.push_back(actor);
    bodies.mass_kg.push_back(10);
    bodies.initial.push_back(pose);
    run_.geoms.push_back({world_, id, kind, shape, size, {}});
  }

 private:
  RunData& run_;
  int world_ = 0, local_body_ = 0;
};

void add_car(Builder& builder) {
  const double x = car_start_x_m;
  builder.body("car", "car", "chassis", {Vec3(x, 0, 0.75), {}}, "box", {3.6, 1.7, 0.7});
  const Quat sideways = turn(M_PI / 2, Vec3(1, 0, 0));
  for (double dx : {-1.2, 1.2}) {
    for (double dy : {-0.95, 0.95}) {
      builder.body("car", "car", "wheel" + std::to_string(dx > 0) + std::to_string(dy > 0),
                   {Vec3(x + dx, dy, 0.35), sideways}, "cylinder", {0.35, 0.22, 0});
    }
  }
}

void add_human(Builder& builder, const std::string& name, double x, double y) {
  const auto part = [&](const std::string& what, double dy, double z, double radius, double length) {
    builder.body(name, "human", what, {Vec3(x, y + dy, z), {}}, "capsule", {radius, length, 0});
  };
  builder.body(name, "human", "head", {Vec3(x, y, 1.66), {}}, "sphere", {0.11, 0, 0});
  builder.body(name, "human", "pelvis", {Vec3(x, y, 0.98), {}}, "box", {0.2, 0.32, 0.18});
  part("chest", 0, 1.3, 0.15, 0.22);
  for (double side : {-1.0, 1.0}) {
    const std::string which = side < 0 ? "right_" : "left_";
    part(which + "upper_arm", side * 0.22, 1.32, 0.05, 0.22);
    part(which + "forearm", side * 0.24, 1.04, 0.04, 0.2);
    part(which + "thigh", side * 0.1, 0.7, 0.08, 0.3);
    part(which + "shin", side * 0.1, 0.29, 0.055, 0.32);
  }
}

void add_wall(Builder& builder) {
  for (int row = 0; row < 5; ++row) {
    for (int column = 0; column < 5; ++column) {
      builder.body("wall", "wall", "brick" + std::to_string(5 * row + column),
                   {Vec3(3.4, (column - 2 + 0.5 * (row % 2)) * 0.62, 0.15 + 0.3 * row), {}}, "box",
                   {0.3, 0.6, 0.29});
    }
  }
}

/// Where a body is `time_s` after the start; see sample_run().
Pose pose_at(const RunData& run, std::size_t body, double time_s) {
  Pose pose = run.bodies.initial[body];
  const double speed = car_speed_m_s + 0.5 * run.bodies.world[body];
  const double car_x = car_start_x_m + speed * time_s;
  const std::string& kind = run.bodies.kind[body];
  if (kind == "car") {
    pose.position.x() += speed * time_s;
    if (run.bodies.local_body[body] > 0) {  // a wheel rolls about its own axis
      pose.orientation = Quat::from_eigen(Eigen::AngleAxisd(speed * time_s / 0.35, Vec3::UnitY()) *
                                          pose.orientation.to_eigen());
    }
  } else if (kind == "projectile") {
    pose.position.x() -= 6 * time_s;
  } else if (car_x > pose.position.x() - 2) {
    const double since = (car_x - (pose.position.x() - 2)) / speed;
    const double height = pose.position.z();
    pose.position += Vec3(since * 6 * height, (static_cast<int>(body) % 5 - 2) * 2.0 * since, 2 * since);
    pose.orientation = Quat::from_eigen(
        Eigen::AngleAxisd((4.0 + static_cast<int>(body) % 7) * since, Vec3(0.2, 1, 0.1).normalized()) *
        pose.orientation.to_eigen());
  }
  return pose;
}

void add_frames(RunData& run, const SampleSize& size) {
  const std::size_t num_bodies = run.bodies.id.size();
  for (int frame = 0; frame < size.num_records; ++frame) {
    const double step = size.steps_per_frame * (frame + 1);
    run.recorded_step.push_back(static_cast<std::int64_t>(step));
    run.recorded_time_s.push_back(step * size.dt_s);
    auto& position = run.position.emplace_back();
    auto& orientation = run.orientation.emplace_back();
    for (std::size_t body = 0; body < num_bodies; ++body) {
      const Pose pose = pose_at(run, body, step * size.dt_s);
      position.push_back(pose.position);
      orientation.push_back(pose.orientation);
    }
  }
}

/// Frame times around 2 ms with one late frame, and per-world counts that fall as things collide.
void add_columns(RunData& run, const SampleSize& size) {
  for (int frame = 0; frame < size.num_records; ++frame) {
    const double wall = (frame == 4 ? 4.1e-3 : 2e-3) + 1e-4 * (frame % 3);
    run.frame_wall_s.push_back(wall);
    run.frame_measured.push_back(frame >= 3);
    run.deadline_met.push_back(wall <= 0.1 / 30);
    std::vector<double> islands, contacts, rows, zeros(static_cast<std::size_t>(size.num_worlds)), gap, depth,
        energy;
    std::vector<Vec3> momentum;
    for (int world = 0; world < size.num_worlds; ++world) {
      islands.push_back(std::max(1, 3 - (frame + world) / 4));
      contacts.push_back(8 + 3 * frame + world % 3);
      rows.push_back(60 + 9 * frame);
      gap.push_back(1e-4 * (frame + 1));
      depth.push_back(2e-3);
      energy.push_back(1000 - 10 * frame);
      momentum.emplace_back(30, 40, 0);
    }
    run.observables["islands"].push_back(islands);
    run.observables["contacts"].push_back(contacts);
    run.observables["rows"].push_back(rows);
    run.observables["nonfinite"].push_back(zeros);
    run.observables["joint_gap"].push_back(gap);
    run.observables["max_penetration"].push_back(depth);
    run.observables["energy"].push_back(energy);
    run.vector_observables["linear_momentum"].push_back(momentum);
    const std::map<std::string, double> share = {{"collide", 0.25}, {"islands", 0.05},   {"rows", 0.1},
                                                 {"solve", 0.35},   {"integrate", 0.05}, {"cross_space", 0},
                                                 {"gather", 0.04},  {"wait", 0.1},       {"output", 0.02}};
    for (const auto& [phase, part] : share) {
      std::vector<double> ranks;
      for (int rank = 0; rank < size.num_ranks; ++rank) ranks.push_back(part * wall * (1 - 0.1 * rank));
      run.rank_times[phase].push_back(ranks);
    }
    std::vector<double> useful;
    for (int rank = 0; rank < size.num_ranks; ++rank) useful.push_back(0.8 * wall * (1 - 0.1 * rank));
    run.rank_times["useful"].push_back(useful);
  }
}

}  // namespace

RunData sample_run(const SampleSize& size) {
  RunData run;
  run.attributes = {
      {"scene", "Sample <crash>"},        {"pbmpi_version", "0.0"},
      {"git_revision", "none"},           {"created", "2006-01-01T00:00:00Z"},
      {"state_hash", "0123456789abcdef"}, {"command_line", "pbmpi --scene \"Sample </script>\""}};
  run.parameters = {{"iterations", "20"},
                    {"substeps", "1"},
                    {"steps_per_frame", "3"},
                    {"dt", "0.01"},
                    {"seed", "1"},
                    {"stepper", "quick"},
                    {"precision", "double"},
                    {"scene_text", "# a scene\nname = \"Sample\"\n"}};
  run.complete = true;
  run.frames_committed = size.num_records;
  run.num_worlds = size.num_worlds;
  run.num_ranks = size.num_ranks;
  run.hosts.assign(static_cast<std::size_t>(size.num_ranks), "node1");
  run.events = {{2, "rebalance", "1 world moved"}};
  run.num_events = {{"rebalance", 1}};
  Builder builder(run);
  for (int world = 0; world < size.num_worlds; ++world) {
    builder.begin_world(world);
    add_car(builder);
    add_human(builder, "human1", 0.6, -0.5);
    add_human(builder, "human2", 0.9, 0.6);
    add_wall(builder);
    builder.body("ball", "projectile", "ball", {Vec3(4.6, -2.2, 0.9), {}}, "sphere", {0.3, 0, 0});
  }
  add_frames(run, size);
  add_columns(run, size);
  return run;
}

}  // namespace pbmpi::io::html
