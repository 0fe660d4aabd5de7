// Tall islands get more substeps, and stiffer springs.
#include "solver/parts/tall_islands.h"

#include <gtest/gtest.h>

#include <numbers>
#include <numeric>

#include "solver/layout/row_law.h"
#include "solver/parts/yards.h"
#include "stepping/stepper_traits.h"

namespace pbmpi::solver {
namespace {

using namespace testing_support;

constexpr double side_m = 0.02;

StepperSettings default_sor() { return default_settings(stepping::StepperKind::sor); }

/// Columns of cubes on the ground with these heights.
Model columns(const std::vector<int>& heights) {
  Model model;
  support::add_ground(model);
  for (std::size_t column = 0; column < heights.size(); ++column) {
    const std::string name = "column" + std::to_string(column);
    const int wall = support::add_actor(model, name, model::ActorKind::wall, true);
    for (int i = 0; i < heights[column]; ++i) {
      support::add_solid(model, wall, name + "." + std::to_string(i), model::Shape::box,
                         {side_m, side_m, side_m}, 1,
                         {static_cast<double>(column), 0, side_m * (0.5 + static_cast<double>(i))});
    }
  }
  return model;
}

/// One contact where a body stands on another one, or on the ground.
model::Contact stands_on(int body, int below) {
  model::Contact contact;
  contact.body_a = below == model::no_body ? body : below;
  contact.body_b = below == model::no_body ? model::no_body : body;
  return contact;
}

std::vector<model::Contact> contacts_of_columns(const std::vector<int>& heights) {
  std::vector<model::Contact> contacts;
  int body = 0;
  for (const int height : heights) {
    for (int i = 0; i < height; ++i, ++body)
      contacts.push_back(stands_on(body, i == 0 ? model::no_body : body - 1));
  }
  return contacts;
}

/// Substeps of all bodies.
std::vector<int> find(const Model& model, const StepperSettings& settings,
                      std::span<const model::Contact> contacts) {
  TallIslands tall(model, settings);
  StepIslands islands(model);
  std::vector<int> substeps(model.bodies.size(), settings.substeps), bodies(model.bodies.size());
  std::iota(bodies.begin(), bodies.end(), 0);
  if (!tall.can_be() || !tall.find(bodies, contacts, {}, islands)) return substeps;
  for (const int body : bodies) substeps[static_cast<std::size_t>(body)] = tall.substeps(body);
  return substeps;
}

/// How far the top sinks, by the formula of tall_islands.h.
double sink_m(int levels, double substeps) {
  const double w = 2 * std::numbers::pi * most_contact_periods * substeps / 0.01;
  return levels * levels / 2.0 * 9.81 / (w * w);
}

TEST(TallIslands, get_so_many_substeps_that_they_sink_by_a_hundredth_of_a_body) {
  const double size_m = std::sqrt(3.0) * side_m;
  for (const int height : {1, 5, 9, 10, 12, 15, 20, 25}) {
    const Model model = columns({height});
    const int substeps = find(model, default_sor(), contacts_of_columns({height})).front();
    if (sink_m(height, 14) <= 0.01 * size_m) {
      EXPECT_EQ(substeps, 14) << height;
      continue;
    }
    EXPECT_GT(substeps, 14) << height;
    EXPECT_GT(sink_m(height, substeps / 1.25), 0.01 * size_m) << height << " has too many";
    if (substeps < 32) {
      EXPECT_LT(sink_m(height, substeps + 1), 0.01 * size_m) << height << " has too few";
    }
  }
  EXPECT_EQ(find(columns({9}), default_sor(), contacts_of_columns({9})).front(), 14);
  EXPECT_EQ(find(columns({40}), default_sor(), contacts_of_columns({40})).front(), 32) << "the most";
}

TEST(TallIslands, are_none_where_a_run_gives_no_more_substeps_has_no_memory_or_no_springs) {
  const Model model = columns({40});
  StepperSettings none_more = default_sor(), forgets = default_sor(), rigid = default_sor();
  none_more.law.most_substeps = none_more.substeps;
  forgets.law.warm_start = 0;
  rigid.law.contact_frequency = 0;
  EXPECT_TRUE(TallIslands(model, default_sor()).can_be());
  for (const StepperSettings& settings : {none_more, forgets, rigid})
    EXPECT_FALSE(TallIslands(model, settings).can_be());
  EXPECT_FALSE(TallIslands(columns({9}), default_sor()).can_be()) << "too few bodies";
  Model floats = columns({40});
  floats.gravity = {0, 0, 0};
  EXPECT_FALSE(TallIslands(floats, default_sor()).can_be());
}

TEST(TallIslands, are_counted_one_by_one_and_by_the_shortest_way_down) {
  const std::vector<int> heights = {20, 5, 20};
  const Model model = columns(heights);
  std::vector<model::Contact> contacts = contacts_of_columns(heights);
  std::vector<int> substeps = find(model, default_sor(), contacts);
  EXPECT_GT(substeps[0], 14);
  EXPECT_EQ(substeps[0], substeps[19]);
  EXPECT_EQ(substeps[20], 14) << "the low one";
  EXPECT_EQ(substeps[25], substeps[0]);
  contacts.push_back(stands_on(10, 22));  // leans on the low column, half as high
  substeps = find(model, default_sor(), contacts);
  EXPECT_LT(substeps[0], substeps[25]);
  EXPECT_EQ(substeps[0], substeps[22]) << "one island";
  contacts.push_back(stands_on(19, model::no_body));  // and is held at its top
  EXPECT_EQ(find(model, default_sor(), contacts)[0], 14);
  contacts = contacts_of_columns(heights);
  contacts.erase(contacts.begin());  // hangs in the air
  EXPECT_EQ(find(model, default_sor(), contacts)[0], 14);
}

TEST(TallIslands, what_whole_joints_hold_together_is_one_level) {
  Model model = columns({20});
  for (int body = 1; body < 20; ++body)
    support::add_joint(model, model::JointKind::ball, body, body - 1, {0, 0, side_m * body}, {0, 0, 1});
  const std::vector<model::Contact> contacts = contacts_of_columns({20});
  EXPECT_EQ(find(model, default_sor(), contacts).front(), 14);
  TallIslands tall(model, default_sor());
  StepIslands islands(model);
  std::vector<int> bodies(20);
  std::iota(bodies.begin(), bodies.end(), 0);
  std::vector<std::int32_t> broken_in(model.joints.size(), model::unbroken);
  EXPECT_FALSE(tall.find(bodies, contacts, broken_in, islands));
  broken_in.assign(model.joints.size(), 3);
  EXPECT_TRUE(tall.find(bodies, contacts, broken_in, islands));
}

TEST(TallIslands, sink_less_and_leave_the_others_as_they_are) {
  const Model model = columns({20, 5});
  StepperSettings none_more = default_sor();
  none_more.law.most_substeps = none_more.substeps;
  const auto soft = start(none_more, model), stiff = start(default_sor(), model);
  for (const auto& stepper : {soft.get(), stiff.get()}) advance(*stepper, 300);
  const auto sunk = [&](const auto& stepper, int body) {
    return model.bodies[static_cast<std::size_t>(body)].pose.position.z() -
           stepper->state(0).position[static_cast<std::size_t>(body)].z();
  };
  EXPECT_GT(sunk(soft, 19), 0.01 * side_m);
  EXPECT_LT(sunk(stiff, 19), 0.5 * sunk(soft, 19));
  EXPECT_EQ(model::hash(part(stiff->state(0), 20, 5)), model::hash(part(soft->state(0), 20, 5)));
}

}  // namespace
}  // namespace pbmpi::solver
