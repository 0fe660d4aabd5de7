#include "space_run.h"

#include <algorithm>
#include <set>

#include <gtest/gtest.h>

#include "../world_driver_support.h"
#include "contact_oracle.h"
#include "ode/collide/narrow_phase.h"
#include "solver/spaces/sor_space_stepper.h"
#include "solver/worlds/sor_stepper.h"
#include "support/models.h"

namespace pbmpi::testing_support {

using model::Shape;

SharedModel share(model::Model model) { return std::make_shared<const model::Model>(std::move(model)); }

const mpi::Communicator& world() {
  static const mpi::Communicator communicator = mpi::Communicator::world();
  return communicator;
}

int add_to_space(model::Model& model, int body, int space) {
  for (model::Geom& geom : model.geoms) {
    if (geom.body == body) geom.space = space;
  }
  return body;
}

mpi::WorldRunSettings space_settings(int frames) {
  mpi::WorldRunSettings settings;
  settings.warmup = 2;
  settings.frames = frames;
  return settings;
}

std::vector<mpi::Placement> placements_of_four_spaces(int num_ranks, int stride) {
  std::set<mpi::Placement> placements;
  for (int code = 0; code < 256; code += stride)
    placements.insert(
        {code % 4 % num_ranks, code / 4 % 4 % num_ranks, code / 16 % 4 % num_ranks, code / 64 % num_ranks});
  return {placements.begin(), placements.end()};
}

std::unique_ptr<stepping::SpaceStepper> make_space_stepper(const SharedModel& model,
                                                           const stepping::StepperSettings& stepper) {
  return solver::make_sor_space_stepper(stepper, ode::make_narrow_phase, model);
}

SpaceRun run_spaces(const mpi::Communicator& comm, const SharedModel& model,
                    const mpi::WorldRunSettings& settings, const stepping::StepperSettings& stepper,
                    Oracle with) {
  const auto world = make_space_stepper(model, stepper);
  mpi::SpaceDriver driver(comm, *world, settings);
  ContactOracle oracle(comm, model, stepper);
  if (with == Oracle::each_step) {
    driver.set_step_hook(
        [&](std::int64_t step, std::span<const model::Contact> contacts) { oracle.check(step, contacts); });
  }
  Recorder recorder;
  driver.add_observer(recorder);
  SpaceRun run;
  run.result = driver.run();
  run.events = recorder.events;
  run.idle_ranks = driver.idle_ranks();
  run.owners = driver.placement();
  run.contacts_checked = oracle.contacts_checked();
  run.contacts_ahead_checked = oracle.contacts_ahead_checked();
  for (const mpi::FrameTimes& times : run.result.times) run.messages += times.traffic.messages;
  return run;
}

std::uint64_t whole_hash(const SharedModel& model, const mpi::WorldRunSettings& settings,
                         const stepping::StepperSettings& stepper) {
  mpi::WorldRunSettings alone = settings;
  alone.placement.clear();
  const auto worlds = solver::make_sor_stepper(stepper, ode::make_narrow_phase);
  mpi::WorldDriver driver(
      mpi::Communicator(), *worlds, [&](int) { return model; }, alone);
  return driver.run().state_hash;
}

namespace {

void add_pile(model::Model& model, const std::string& name, double x, int space) {
  const int actor = support::add_actor(model, name, model::ActorKind::wall, true);
  for (int i = 0; i < 6; ++i) {
    const int body = support::add_solid(model, actor, name + std::to_string(i), Shape::box, {0.5, 0.5, 0.5},
                                        2, {x + 0.06 * (i % 3), 0.05 * (i % 2), 0.3 + 0.52 * i},
                                        support::rotation(model::Vec3(1, 1, 0).normalized(), 0.05 * i));
    add_to_space(model, body, space);
  }
}

void add_chain(model::Model& model, double x, int space) {
  const int actor = support::add_actor(model, "chain");
  int previous = model::no_body;
  for (int i = 0; i < 5; ++i) {
    const int link = support::add_solid(model, actor, "link" + std::to_string(i), Shape::capsule,
                                        {0.05, 0.4, 0}, 1, {x - 1 + 0.5 * i, 0, 3.5},
                                        support::rotation(model::Vec3::UnitY(), 1.5707963267948966));
    add_to_space(model, link, space);
    if (previous != model::no_body)
      support::add_joint(model, model::JointKind::ball, link, previous, {x - 1.25 + 0.5 * i, 0, 3.5});
    previous = link;
  }
}

void add_balls(model::Model& model, double x, int space) {
  for (int i = 0; i < 4; ++i) {
    const std::string name = "ball" + std::to_string(i);
    const int actor = support::add_actor(model, name, model::ActorKind::projectile);
    const int body =
        support::add_solid(model, actor, name, Shape::sphere, {0.2, 0, 0}, 1, {x + 0.5 * i, 0.1 * i, 0.2});
    add_to_space(model, body, space);
    model.bodies[body].velocity = {i % 2 == 0 ? -6.0 : 0.0, 0, 0};
    model::Event event;
    event.step = 12 + 9 * i;
    event.kind = model::EventKind::launch;
    event.body = body;
    event.velocity = {2, 0, -3};
    if (i != 2) event.pose = model::Pose{{1.0 * i, 0.1, 4}, {}};  // among the others; one keeps its position
    model.events.push_back(event);
  }
}

}  // namespace

void expect_whole_in_placements(const SharedModel& model, int frames, int stride) {
  mpi::WorldRunSettings settings = space_settings(frames);
  settings.rebalance_threshold = model::infinity;
  for (const stepping::Precision precision : {stepping::Precision::double_, stepping::Precision::single}) {
    stepping::StepperSettings stepper = ode_steps;
    stepper.precision = precision;
    const std::uint64_t expected = whole_hash(model, settings, stepper);
    for (const mpi::Placement& placement : placements_of_four_spaces(world().size(), stride)) {
      settings.placement = placement;
      const SpaceRun run = run_spaces(world(), model, settings, stepper, Oracle::none);
      ASSERT_EQ(run.result.state_hash, expected) << testing::PrintToString(placement);
    }
  }
}

model::Model neighbours() {
  model::Model model;
  support::add_ground(model);
  model.spaces = {"left", "middle", "right", "balls"};
  add_pile(model, "left", 0, 0);
  add_chain(model, 1, 1);
  add_pile(model, "right", 2, 2);
  add_balls(model, 4, 3);
  return model;
}

model::Model on_collision_course(model::Model model) {
  const auto body_in = [&](int space) {
    for (auto geom = model.geoms.rbegin(); geom != model.geoms.rend(); ++geom) {
      if (geom->body != model::no_body && geom->space == space) return geom->body;
    }
    return model::no_body;
  };
  model::Event launch;
  launch.step = 22;
  launch.body = body_in(3);
  launch.pose = model.bodies[body_in(0)].pose;
  launch.pose->position = {0, 0, 0.2};
  model.events.push_back(launch);
  std::ranges::stable_sort(model.events, {}, &model::Event::step);
  return model;
}

model::Model shoot_out() {
  model::Model model = neighbours();
  for (std::size_t i = 0; i < model.events.size(); ++i) {
    model::Event& event = model.events[i];
    const bool high = i < 2;  // above the piles
    const double side = i % 2 == 0 ? 1 : -1;
    event.step = high ? 12 : 30;
    event.velocity = {side * (60 + 10 * static_cast<double>(i)), 0, 0};
    event.pose = model::Pose{{1 - 2.5 * side, 0.1, high ? 5.0 : 1.4}, {}};
  }
  return model;
}

}  // namespace pbmpi::testing_support
