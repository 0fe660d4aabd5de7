// --sag: loaded islands get more substeps, and stiffer springs.
#include "solver/parts/loaded_islands.h"

#include <gtest/gtest.h>

#include <numbers>
#include <numeric>
#include <random>
#include <utility>

#include "core/error.h"
#include "solver/pack/step_settings.h"
#include "solver/parts/yards.h"

namespace pbmpi::solver {
namespace {

using namespace testing_support;

/// All joints are springs, and none is solved exactly. Loaded islands get four times as many substeps.
StepperSettings settings_with(double sag_m) {
  StepperSettings settings = default_settings(stepping::StepperKind::sor);
  settings.joint_solver = stepping::JointSolver::sweeps;
  settings.substeps = 8;
  settings.sag_m = sag_m;
  return settings;
}

/// A ball on a light one that hangs on a joint.
Model heavy_on_light(double ratio) {
  Model model;
  const int actor = support::add_actor(model, "chain");
  const int light =
      support::add_solid(model, actor, "light", model::Shape::sphere, {0.1, 0, 0}, 1, {0, 0, 3});
  const int heavy =
      support::add_solid(model, actor, "heavy", model::Shape::sphere, {0.3, 0, 0}, ratio, {0, 0, 2});
  support::add_joint(model, model::JointKind::ball, light, model::no_body, {0, 0, 3.5}, model::Vec3::UnitZ());
  support::add_joint(model, model::JointKind::ball, heavy, light, {0, 0, 2.5}, model::Vec3::UnitZ());
  return model;
}

/// A stack of boxes of growing mass.
Model stack(double ratio) {
  Model model;
  support::add_ground(model);
  const int wall = support::add_actor(model, "wall", model::ActorKind::wall, true);
  for (int i = 0; i < 3; ++i) {
    support::add_solid(model, wall, "box" + std::to_string(i), model::Shape::box, {0.5, 0.5, 0.5},
                       std::pow(ratio, i), {0, 0, 0.25 + 0.5 * i});
  }
  return model;
}

std::vector<int> all_bodies(const Model& model) {
  std::vector<int> bodies(model.bodies.size());
  std::iota(bodies.begin(), bodies.end(), 0);
  return bodies;
}

/// Does find() count an island of this state as loaded at this sag?
bool is_loaded(const Model& model, const State& state, std::span<const model::Contact> contacts,
               double sag_m) {
  std::vector<int> loaded;
  LoadedIslands(model, settings_with(sag_m))
      .find(all_bodies(model), contacts, state.memory.contacts, {}, state, loaded);
  return !loaded.empty();
}

TEST(LoadedIslands, are_those_whose_joints_give_by_more_than_the_sag) {
  for (const double ratio : {1.0, 30.0, 300.0}) {
    const Model model = heavy_on_light(ratio);
    const auto stepper = start(settings_with(0), model);
    advance(*stepper, 1500);
    const State& state = stepper->state(0);
    const double gap = stepper->observables(0).joint_gap_m;
    EXPECT_GT(gap, 8e-6 * ratio);
    EXPECT_TRUE(is_loaded(model, state, {}, 0.97 * gap)) << ratio;
    EXPECT_FALSE(is_loaded(model, state, {}, 1.03 * gap)) << ratio;
  }
}

TEST(LoadedIslands, stay_so_down_to_an_eighth_of_the_sag) {
  for (const double ratio : {1.0, 30.0, 300.0}) {
    const Model model = heavy_on_light(ratio);
    const auto soft = start(settings_with(0), model), stiff = start(settings_with(1e-9), model);
    for (const auto& stepper : {soft.get(), stiff.get()}) advance(*stepper, 1500);
    const double give = soft->observables(0).joint_gap_m;
    EXPECT_NEAR(stiff->observables(0).joint_gap_m, give / 16, give / 160);
    for (const double share : {0.15, 0.6, 0.9}) {
      EXPECT_FALSE(is_loaded(model, soft->state(0), {}, give / share)) << ratio;
      EXPECT_TRUE(is_loaded(model, stiff->state(0), {}, give / share)) << ratio;
    }
    EXPECT_FALSE(is_loaded(model, stiff->state(0), {}, give / 0.1)) << ratio;
  }
}

// Otherwise it would alternately be pushed out and let down.
TEST(LoadedIslands, a_column_rests_whatever_sag_is_named) {
  Model model;
  support::add_ground(model);
  const int wall = support::add_actor(model, "wall", model::ActorKind::wall, true);
  for (int i = 0; i < 10; ++i) {
    support::add_solid(model, wall, "box" + std::to_string(i), model::Shape::box, {0.5, 0.5, 0.5}, 1,
                       {0, 0, 0.25 + 0.5 * i});
  }
  for (double sag_m = 1e-4; sag_m < 1.2e-3; sag_m *= 1.15) {
    const auto stepper = start(settings_with(sag_m), model);
    advance(*stepper, 300);
    double sweeps = sweeps_a_row(*stepper);
    for (int step = 0; step < 100; ++step) {
      advance(*stepper, 1);
      ASSERT_EQ(sweeps_a_row(*stepper), sweeps) << sag_m;
      sweeps = sweeps_a_row(*stepper);
      for (const model::Vec3& velocity : stepper->state(0).velocity)
        ASSERT_LT(velocity.norm(), 5e-3) << sag_m;
    }
  }
}

TEST(LoadedIslands, are_those_whose_contacts_give_by_more_than_the_sag) {
  StepperSettings settings = settings_with(0);
  settings.contacts = true;
  for (const double ratio : {1.0, 3.0, 10.0}) {
    const Model model = stack(ratio);
    const auto stepper = start(settings, model);
    advance(*stepper, 1500);
    const double depth = stepper->observables(0).max_penetration_m;
    EXPECT_GT(depth, 1e-5);
    const std::vector<model::Contact>& contacts = stepper->contacts(0)->contacts;
    EXPECT_TRUE(is_loaded(model, stepper->state(0), contacts, 0.9 * depth)) << ratio;
    EXPECT_FALSE(is_loaded(model, stepper->state(0), contacts, 1.1 * depth)) << ratio;
  }
}

// An island that is skipped because of its bounds is not loaded.
TEST(LoadedIslands, forces_that_give_little_wherever_they_act_are_those_of_no_loaded_island) {
  Model model = heavy_on_light(3);
  std::mt19937 random(5);
  std::uniform_real_distribution<double> number(-1, 1);
  const auto vector = [&] { return model::Vec3(number(random), number(random), number(random)); };
  for (model::Body& body : model.bodies) body.inertia = model::Vec3(0.002, 0.05, 0.03).asDiagonal();
  int num_loaded = 0;
  for (int trial = 0; trial < 5000; ++trial) {
    State state = model::initial_state(model);
    for (model::Quat& turn : state.orientation)
      turn = model::Quat::from_eigen(Eigen::Quaterniond::UnitRandom());
    state.memory.joints.resize(model.joints.size());
    state.memory.joints[1].force = vector();
    state.memory.joints[1].torque = vector();
    // By hand: the largest deflection over all poses of the bodies is not below that of these poses.
    const model::JointForce& force = state.memory.joints[1];
    const auto inverse = model.bodies[0].inertia.inverse().eval();
    const auto accelerations_of = [&](int body, const model::Vec3& anchor) -> std::pair<double, double> {
      const auto b = static_cast<std::size_t>(body);
      const model::Mat3 turn = state.orientation[b].to_eigen().toRotationMatrix();
      const auto turned = [&](const model::Vec3& torque) -> model::Vec3 {
        return turn * inverse * turn.transpose() * torque;
      };
      const model::Vec3 arm = turn * anchor, lever = arm.cross(force.force);
      const double pull = force.force.norm(), torque = force.torque.norm();
      const double radius = b == 0 ? 0.1 : 0.3;
      return {pull / model.bodies[b].mass_kg + lever.dot(turned(lever)) / pull,
              radius * force.torque.dot(turned(force.torque)) / torque};
    };
    const StepperSettings settings = settings_with(0);
    const auto per_acceleration = [&](const Spring& spring) {
      const double w = 2 * std::numbers::pi * spring.frequency_in(settings.dt_s / settings.substeps);
      return 1 / (w * w);
    };
    const auto [pulled_a, turned_a] = accelerations_of(1, model.joints[1].anchor_a);
    const auto [pulled_b, turned_b] = accelerations_of(0, model.joints[1].anchor_b);
    const double give = (pulled_a + pulled_b) * per_acceleration(joint_place_spring(settings)) +
                        (turned_a + turned_b) * per_acceleration(joint_turn_spring(settings));
    EXPECT_TRUE(is_loaded(model, state, {}, 0.999 * give));
    num_loaded += is_loaded(model, state, {}, 8.001 * give) ? 1 : 0;
  }
  EXPECT_EQ(num_loaded, 0) << "beyond the band";
}

TEST(LoadedIslands, give_less_and_leave_the_others_as_they_are) {
  Model model = yards(true, false);
  const int num_others = model.num_bodies();
  const Model others = model;
  const int actor = support::add_actor(model, "load");
  const int light =
      support::add_solid(model, actor, "light", model::Shape::sphere, {0.1, 0, 0}, 1, {50, 0, 13});
  const int heavy =
      support::add_solid(model, actor, "heavy", model::Shape::sphere, {0.3, 0, 0}, 500, {50, 0, 12});
  support::add_joint(model, model::JointKind::ball, light, model::no_body, {50, 0, 13.5}, {0, 0, 1});
  support::add_joint(model, model::JointKind::ball, heavy, light, {50, 0, 12.5}, {0, 0, 1});
  const auto soft = start(settings_with(0), model), stiff = start(settings_with(2e-3), model),
             alone = start(settings_with(0), others);
  for (const auto& stepper : {soft.get(), stiff.get(), alone.get()}) advance(*stepper, 1500);
  EXPECT_GT(soft->observables(0).joint_gap_m, 4e-3);
  EXPECT_LT(stiff->observables(0).joint_gap_m, soft->observables(0).joint_gap_m / 15)
      << "16 times stiffer springs";
  EXPECT_EQ(model::hash(part(stiff->state(0), 0, num_others)),
            model::hash(part(alone->state(0), 0, num_others)));
  const double loaded_rows = stiff->observables(0).rows - alone->observables(0).rows;
  EXPECT_EQ(stiff->observables(0).row_visits - alone->observables(0).row_visits, loaded_rows * 32 * 2);
}

TEST(LoadedIslands, change_no_bit_where_little_is_carried) {
  const Model model = yards(true, true);
  const auto all = start(settings_with(0), model), loaded = start(settings_with(1), model);
  for (int step = 0; step < 100; ++step) {
    advance(*all, 1);
    advance(*loaded, 1);
    ASSERT_EQ(model::hash(all->state(0)), model::hash(loaded->state(0))) << step;
  }
}

TEST(LoadedIslands, have_the_bits_of_a_run_in_which_all_get_as_much) {
  const Model model = yards(true, false);
  StepperSettings all = settings_with(0);
  all.substeps = 32;
  const auto path = start(settings_with(0), model);
  advance(*path, 200);
  const auto loaded = start(settings_with(1e-9), model, path->state(0), 200),
             every = start(all, model, path->state(0), 200);
  for (int step = 0; step < 50; ++step) {
    advance(*loaded, 1);
    advance(*every, 1);
    ASSERT_EQ(model::hash(loaded->state(0)), model::hash(every->state(0))) << step;
  }
}

TEST(LoadedIslands, a_force_that_is_no_number_is_too_much) {
  const Model model = heavy_on_light(1);
  State state = model::initial_state(model);
  state.memory.joints.resize(model.joints.size());
  EXPECT_FALSE(is_loaded(model, state, {}, 1e-3));
  state.memory.joints[0].force.x() = NAN;
  EXPECT_TRUE(is_loaded(model, state, {}, 1e-3));
}

TEST(LoadedIslands, need_a_memory) {
  StepperSettings settings = settings_with(1e-3);
  settings.warm_start = 0;
  EXPECT_THROW(start(settings, heavy_on_light(1)), core::InputError);
}

}  // namespace
}  // namespace pbmpi::solver
