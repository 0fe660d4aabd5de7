// CrashWa, Environ, Battle, Fight and Battle2 stepped by ODE.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "../helpers.h"
#include "../simulation.h"
#include "stepping/stepper_traits.h"

namespace pbmpi::scenes {
namespace {

/// Table 1's row, and the number of spaces in its two forms.
struct Row {
  const char* scene;
  double max, min, mean;
  int spaces;
};

std::ostream& operator<<(std::ostream& out, const Row& row) { return out << row.scene; }

class Suite : public testing::TestWithParam<Row> {};

TEST_P(Suite, has_the_papers_islands_in_the_window_within_ten_percent) {
  const Row& row = GetParam();
  const auto islands = measured_islands(row.scene, 1);
  EXPECT_NEAR(*std::max_element(islands.begin(), islands.end()), row.max, 0.1 * row.max);
  EXPECT_NEAR(mean(islands), row.mean, 0.1 * row.mean);
  // Battle's minimum of 2 cannot be reached, for a reason given in its scene file.
  if (row.min > 2) {
    EXPECT_NEAR(*std::min_element(islands.begin(), islands.end()), row.min, 0.1 * row.min);
  }
}

TEST_P(Suite, stays_finite_for_a_second_after_the_start) {
  const auto scene = parse_scene(find_scene(GetParam().scene));
  Simulation run(*scene, 1);
  for (int i = 0; i < 4; ++i) {
    run.steps(25);
    EXPECT_EQ(run.observables(0).nonfinite, 0) << i;
  }
}

TEST_P(Suite, is_the_same_world_in_one_space_and_in_the_papers_many) {
  const std::string base(GetParam().scene);
  const std::string variant = "title = \"t\"\nbase = \"" + base + "\"\n[run]\nspaces = \"one\"\n";
  const auto one = parse_scene({"t", "t.toml", variant})->build(0, 1);
  const auto many = parse_scene(find_scene(base))->build(0, 1);
  EXPECT_EQ(one->spaces.size(), 1u);
  EXPECT_EQ(many->spaces.size(), static_cast<std::size_t>(GetParam().spaces));
  EXPECT_EQ(fingerprint(*one), fingerprint(*many));
  std::vector<int> geoms(many->spaces.size());
  for (const model::Geom& geom : many->geoms) ++geoms[geom.space];
  EXPECT_EQ(std::count(geoms.begin(), geoms.end(), 0), 0);  // no space is empty
  for (const model::Geom& geom : one->geoms) EXPECT_EQ(geom.space, 0);
}

INSTANTIATE_TEST_SUITE_P(Table1, Suite,
                         testing::Values(Row{"CrashWa", 105, 99, 101, 3}, Row{"Environ", 337, 196, 245, 10},
                                         Row{"Battle", 120, 2, 93, 3}, Row{"Fight", 10, 7, 8, 10},
                                         Row{"Battle2", 156, 113, 134, 15}),
                         [](const auto& test) { return std::string(test.param.scene); });

// The wall must stand until the car arrives, after 19 steps.
TEST(CrashWa, its_wall_stands_until_it_is_hit) {
  const auto scene = parse_scene(find_scene("CrashWa"));
  const auto model = scene->build(0, 1);
  Simulation run(*scene, 1);
  run.steps(17);  // the first round reaches it in the next step
  for (int i = 0; i < model->num_bodies(); ++i) {
    if (model->actors[model->bodies[i].actor].kind != model::ActorKind::wall) continue;
    // Blocks settle by the solver's residual: 1 % of a block's height.
    EXPECT_LT((run.state(0).position[i] - model->bodies[i].pose.position).norm(), 0.004)
        << model->bodies[i].name;
  }
  run.steps(7);  // 0.24 s: the car, at 0.894 m per step, has passed through the wall
  EXPECT_GT(run.state(0).position[index_of(*model, "car.chassis")].x(), -1);
}

TEST(Wall, stands_for_two_seconds_with_an_opening) {
  const auto scene = parse(scene_with("wall",
                                      "length = 8\nheight = 3.2\nblock = [0.8, 0.5, 0.4]\n"
                                      "opening = { width = 1.2, height = 1.6 }\n") +
                           "[contact]\nsoft_cfm = 1e-6\n");
  const auto model = scene->build(0, 1);
  Simulation run(*scene, 1);
  run.steps(200);
  for (int i = 0; i < model->num_bodies(); ++i) {
    // Measured 5 mm: 20 iterations leave friction rows unsolved, and blocks creep.
    EXPECT_LT((run.state(0).position[i] - model->bodies[i].pose.position).norm(), 0.02)
        << model->bodies[i].name;
  }
  EXPECT_LT(run.observables(0).max_penetration_m, 0.02);
}

TEST(Tank, rests_without_jitter_with_quick_and_direct) {
  for (const auto kind : {stepping::StepperKind::quick, stepping::StepperKind::direct}) {
    const auto scene = parse(scene_with("tank"));
    const auto model = scene->build(0, 1);
    Simulation run(*scene, 1, 1, kind);
    run.steps(200);
    for (int i = 0; i < model->num_bodies(); ++i) {
      EXPECT_LT((run.state(0).position[i] - model->bodies[i].pose.position).norm(), 0.01);  // measured 2 mm
      EXPECT_LT(run.state(0).velocity[i].norm(), 0.02);
    }
    EXPECT_LT(run.observables(0).joint_gap_m, 0.005);
  }
}

TEST(Centipede, walks_ahead_on_its_legs) {
  const auto scene = parse(scene_with("centipede"));
  const auto model = scene->build(0, 1);
  Simulation run(*scene, 1);
  run.steps(200);
  const int head = index_of(*model, "a.segment1");
  const Vec3 moved = run.state(0).position[head] - model->bodies[head].pose.position;
  EXPECT_GT(moved.x(), 0.3);            // measured 0.8 m in four strides of 0.5 s
  EXPECT_LT(std::abs(moved.y()), 0.5);  // roughly straight ahead
  EXPECT_LT(std::abs(moved.z()), 0.1);  // neither sunk nor overturned
}

const std::string gun = scene_with(
    "tank",
    "[[actor]]\nname = \"shell\"\ntype = \"projectile\"\nshape = \"cylinder\"\nradius = 0.1\nlength = 0.3\n"
    "density = 4000\nposition = [0, 5, 0]\nfired_by = \"a\"\nmuzzle_speed = 40\nfirst_shot = 0.1\n");

TEST(Projectile, flies_where_it_is_aimed) {
  const auto scene = parse(gun);
  const auto model = scene->build(0, 1);
  Simulation run(*scene, 1);
  const int shell = index_of(*model, "shell");
  run.steps(10);
  EXPECT_NEAR(run.state(0).position[shell].y(), 5, 0.01);
  run.steps(20);
  const Pose start = *model->events.at(0).pose;
  // Semi-implicit Euler: n steps of free fall are g dt^2 n (n + 1) / 2.
  const Vec3 expected = start.position + Vec3(40 * 0.2, 0, -9.81 * 1e-4 * 20 * 21 / 2);
  EXPECT_LT((run.state(0).position[shell] - expected).norm(), 1e-9);  // rounding
}

TEST(Projectile, appears_at_the_muzzle_the_same_after_a_restart_before_or_after_the_launch) {
  const auto scene = parse(gun);
  const std::shared_ptr<const model::Model> model = scene->build(0, 1);
  const auto make = [] {
    return ode::make_ode_stepper(default_settings(stepping::StepperKind::quick), [](const std::string&) {});
  };
  core::PhaseTimes times;
  const auto whole = make();
  whole->add(0, model, model::initial_state(*model), 0);
  whole->advance(30, times);
  for (const int cut : {9, 10, 11, 20}) {
    const auto first = make();
    first->add(0, model, model::initial_state(*model), 0);
    first->advance(cut, times);
    const auto second = make();
    second->add(0, model, first->state(0), cut);
    second->advance(30 - cut, times);
    EXPECT_EQ(model::hash(second->state(0)), model::hash(whole->state(0))) << cut;
  }
}

}  // namespace
}  // namespace pbmpi::scenes
