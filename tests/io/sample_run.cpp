#include "sample_run.h"

namespace pbmpi::io::test {

using model::Vec3;

double sample_position(int world, int body, std::int64_t frame, int axis) {
  return 1000.0 * world + 10.0 * body + 0.25 * static_cast<double>(frame) + 0.0625 * axis + 1.0;
}

double sample_wall_s(std::int64_t frame) { return 1e-3 * static_cast<double>(frame + 1); }

double sample_phase_s(int rank, int phase, std::int64_t frame) {
  return 1e-4 * (rank + 1) + 1e-5 * (phase + 1) + 1e-6 * static_cast<double>(frame);
}

std::shared_ptr<const model::Model> sample_model(const Sample& sample, int world) {
  auto made = std::make_shared<model::Model>();
  made->actors = {{"floor", model::ActorKind::ground, false}, {"human1", model::ActorKind::human, false}};
  made->geoms.push_back({model::no_body, 0, 0, model::Shape::plane, {}, {}, {}});
  for (int b = 0; b < sample.bodies_per_world + world % 2; ++b) {
    model::Body body;
    // World 0 has the longest name, so a rank without it must learn the length from another rank.
    body.name = (world == 0 ? "human1.left_upper_arm_é" : "human1.b") + std::to_string(b);
    body.actor = 1;
    body.mass_kg = 2.0 + b;
    body.inertia = (model::Mat3() << 4 + b, 0.5, 0.25, 0.5, 5, 0.125, 0.25, 0.125, 6 + world).finished();
    body.velocity = Vec3(b, 0, world);
    body.pose.position = Vec3(world, b, 0.5);
    made->bodies.push_back(body);
    const model::Shape shape = b % 2 == 0 ? model::Shape::capsule : model::Shape::box;
    made->geoms.push_back({b, 1, 0, shape, {0.1, 0.2, 0.3}, {Vec3(0, 0, 0.01 * b), {}}, {}});
  }
  model::Joint neck;
  neck.name = "human1.neck";
  neck.kind = model::JointKind::universal;
  neck.body_a = 1;
  neck.body_b = 0;
  neck.anchor_a = Vec3(0.5 * world, 0.25, 0);
  neck.anchor_b = Vec3(0, 0, 0.125);
  neck.limits[0] = {-1, 2};
  neck.motors[0] = {0.5, 8, 0.25};
  made->joints.push_back(neck);
  if (world % 2 == 0) {
    model::Joint rope;
    rope.name = "human1.rope";
    rope.body_a = 2;
    made->joints.push_back(rope);
  }
  made->pair_materials.push_back({0, 1, {0.25 * world, 0.5}});
  return made;
}

model::State sample_state(const Sample& sample, int world, std::int64_t frame) {
  model::State state;
  state.resize(sample.bodies_per_world + world % 2);
  for (int b = 0; b < state.num_bodies(); ++b) {
    for (int axis = 0; axis < 3; ++axis) state.position[b][axis] = sample_position(world, b, frame, axis);
    state.orientation[b] = {1.0, 0.125 * world, 0.125 * b, 0.5 * static_cast<double>(frame)};
    state.velocity[b] = -state.position[b];
    state.angular_velocity[b] = 2 * state.position[b];
  }
  state.broken_in.assign(static_cast<std::size_t>(2 - world % 2), model::unbroken);
  if (frame >= 3) state.broken_in[0] = 7;
  return state;
}

stepping::Observables sample_observables(int world, std::int64_t frame) {
  const int k = static_cast<int>(frame);
  return {.contacts = 100 * world + k,
          .rows = 300 * world + k,
          .islands = world + 1,
          .max_island_rows = 7 + k,
          .bodies_inside = 10 * world + k,
          .row_visits = 4800.0 * world + k,
          .energy_j = 0.5 * world + k,
          .max_penetration_m = 1e-3 * (world + 1),
          .joint_gap_m = 1e-4 * (k + 1),
          .nonfinite = 0,
          .linear_momentum = {0.5 * world, 0.25 * k, -1.0},
          .angular_momentum = {1.0 * world, -0.5 * k, 2.0},
          .residuals = {1e-3 * (k + 1), 2e-3 * k, 1e-4 * world, 3e-3 * (k + 1), 4e-3 * k}};
}

stepping::StepProfile sample_profile(const Sample& sample, int world, std::int64_t frame) {
  const int others = sample.bodies_per_world + world % 2 - 1;
  const auto k = static_cast<double>(frame);
  stepping::StepProfile profile;
  profile.islands = {{0, 1, world, 3 * world, 1e-6 * (k + 1)}, {1, others, 7, 21, 1e-5 * (world + 1)}};
  profile.collide_s = 1e-4 * (k + 1);
  profile.collide_spaces_s = 1e-5 * (k + 1);
  profile.cross_contacts = world + static_cast<int>(frame);
  return profile;
}

stepping::StepContacts sample_contacts(const Sample& sample, int world, std::int64_t frame) {
  stepping::StepContacts shown;
  const auto k = static_cast<double>(frame);
  for (int i = 0; i < (world + static_cast<int>(frame)) % 4; ++i) {
    model::Contact contact;
    contact.body_a = i % 2;
    contact.geoms = {0, 1 + i};
    contact.position = Vec3(world, k, i);
    contact.normal = Vec3::UnitZ();
    contact.depth = 0.25 * i;
    contact.mu = 0.5;
    auto force = model::ContactForce::at(contact, contact.position);
    force.arm = Vec3(0.5, 0, k);
    force.normal = 8.0 * (i + 1);
    force.friction = Vec3(world, -k, 0);
    shown.contacts.push_back({contact, force});
  }
  shown.joints.resize(sample_model(sample, world)->joints.size());
  for (model::JointForce& force : shown.joints) {
    force.force = Vec3(world, k, 1);
    force.torque = Vec3(0, 0.5 * k, 0);
    force.control[1] = -k;
  }
  return shown;
}

RankWorlds::RankWorlds(const Sample& sample, std::int64_t frame) {
  std::vector<int> ids;
  for (int w = 0; w < sample.num_worlds; ++w) {
    if (sample.owner_of(w, frame) == sample.rank) ids.push_back(w);
  }
  for (const int w : ids) {
    models.push_back(sample_model(sample, w));
    states.push_back(sample_state(sample, w, frame));
    observables.push_back(sample_observables(w, frame));
    profiles.push_back(sample_profile(sample, w, frame));
    contacts.push_back(sample_contacts(sample, w, frame));
  }
  for (std::size_t i = 0; i < ids.size(); ++i) {
    worlds.push_back({ids[i], models[i].get(), &states[i], &observables[i], &profiles[i], &contacts[i]});
  }
}

RunSetup sample_setup(const Sample& sample, const RankWorlds& at_start, const std::string& path) {
  RunSetup setup;
  setup.path = path;
  setup.attributes = {Parameter::of("scene", std::string("Sample")), Parameter::of("seed", std::int64_t{7}),
                      Parameter::of("pbmpi_version", std::string("0.1.0")),
                      Parameter::of("created", std::string("2024-01-02T03:04:05Z"))};
  setup.parameters = {Parameter::of("dt_s", 0.01), Parameter::of("iterations", std::int64_t{20}),
                      Parameter::of("scene_text", std::string("[[actor]]\nkind = \"human\"\n")),
                      Parameter::of("empty", std::string())};
  for (int w = 0; w < sample.num_worlds; ++w) {
    setup.table.body_offset.push_back(setup.table.body_offset.back() + sample.bodies_per_world + w % 2);
  }
  setup.worlds = at_start.worlds;
  for (int r = 0; r < sample.num_ranks; ++r) setup.hosts.push_back("node" + std::to_string(r));
  setup.num_frames = sample.num_frames;
  setup.record_every = sample.record_every;
  setup.optional.profile = sample.profile;
  setup.flush_interval_s = 1e9;
  setup.optional.estimate = true;
  setup.optional.contacts = sample.contacts;
  setup.optional.breaks = true;
  setup.substep_s = 0.5;
  setup.optional.residuals = true;
  setup.optional.interest = true;
  return setup;
}

/// The estimate of the sample: every body is 0.5 m away from its precise position.
RankWorlds sample_estimate(const Sample& sample, std::int64_t frame) {
  RankWorlds worlds(sample, frame);  // returned without a copy, so its pointers stay valid
  for (model::State& state : worlds.states) {
    for (Vec3& position : state.position) position.x() += 0.5;
  }
  return worlds;
}

void put_frame(RunFile& file, const Sample& sample, std::int64_t frame) {
  const RankWorlds worlds(sample, frame);
  stepping::FrameRecord record;
  record.frame = frame;
  record.step = 3 * (frame + 1);
  record.time_s = 0.01 * static_cast<double>(record.step);
  record.measured = frame >= 2;
  record.worlds = worlds.worlds;
  for (int phase = 0; phase < core::num_phases; ++phase) {
    record.phases.seconds[phase] = sample_phase_s(sample.rank, phase, frame);
  }
  record.traffic = {frame + 10 * sample.rank, 8 * frame + 1000 * sample.rank};
  record.processor_s = 1e-3 * static_cast<double>(frame + 100 * sample.rank);
  record.wall_s = sample_wall_s(frame);
  record.deadline_met = frame % 2 == 0;
  const RankWorlds estimated = sample_estimate(sample, frame);
  const stepping::EstimateRecord estimate{estimated.worlds, 0.25 * record.wall_s, 1e-4 * (sample.rank + 1)};
  record.estimate = &estimate;
  file.frame_done(record);
}

}  // namespace pbmpi::io::test
