#include "solver/spaces/sor_space_stepper.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "core/random.h"
#include "geometry/geometry.h"
#include "ode/collide/narrow_phase.h"
#include "solver/collide/broad_phase.h"
#include "solver/sor_run.h"
#include "solver/spaces/cross_broad_phase.h"
#include "solver/spaces/space_bodies.h"
#include "stepping/stepper_traits.h"
#include "support/body_poses.h"
#include "support/models.h"

namespace pbmpi::solver {
namespace {

using model::GeomPair;

constexpr int num_spaces = 5;

/// Loose solids of all shapes in a cube above the ground, some of them in one actor; spaces overlap.
model::Model cloud(int count, double side) {
  model::Model model;
  model.spaces.assign(num_spaces, "");
  support::add_ground(model);
  for (int i = 0; i < count; ++i) {
    const auto number = [&](std::uint64_t k) {
      return core::to_unit(core::mix_key(5, static_cast<std::uint64_t>(i), k));
    };
    const int actor = support::add_actor(model, "solid" + std::to_string(i / 2));
    support::add_solid(model, actor, "body" + std::to_string(i), static_cast<model::Shape>(i % 4),
                       {0.2 + 0.3 * number(0), 0.3 + 0.4 * number(1), 0.4}, 1,
                       {side * number(2), side * number(3), side * number(4)},
                       support::rotation(model::Vec3(number(5), number(6), 1).normalized(), 6 * number(7)));
    model.geoms.back().space = static_cast<int>(model.geoms.back().body * 7 / count) % num_spaces;
  }
  return model;
}

TEST(CrossBroadPhase, finds_the_pairs_of_the_whole_world_that_cross_owners) {
  const model::Model model = cloud(120, 2.5);
  const model::SpaceMap map = model::make_space_map(model);
  const auto poses = support::body_poses(model);
  std::vector<geometry::Box> boxes(num_spaces);
  for (int space = 0; space < num_spaces; ++space) {
    for (const int geom : map.geoms_of_space[space])
      boxes[space].include(geometry::geom_box(model.geoms[geom], poses[model.geoms[geom].body]));
  }
  std::vector<GeomPair> all, found;
  std::vector<geometry::Box> geom_boxes;
  for (const model::Geom& geom : model.geoms)
    geom_boxes.push_back(geom.body == model::no_body ? geometry::Box()
                                                     : geometry::geom_box(geom, poses[geom.body]));
  BroadPhase(model, support::all_geoms(model)).append_pairs(geom_boxes, nullptr, all);
  const SpaceBodies bodies(model, map);
  CrossBroadPhase cross(model, bodies);
  for (const std::vector<int>& owner :
       {std::vector<int>{0, 1, 2, 3, 4}, {0, 0, 1, 1, 0}, {2, 2, 2, 2, 2}, {1, 0, 0, 0, 0}}) {
    std::vector<GeomPair> expected;
    for (const GeomPair& pair : all) {
      const int a = model.geoms[pair.first].body, b = model.geoms[pair.second].body;
      if (a >= 0 && b >= 0 && owner[map.space_of_body(a)] != owner[map.space_of_body(b)])
        expected.push_back(pair);
    }
    cross.find_pairs(owner, boxes, poses, found);
    EXPECT_EQ(found, expected);
    EXPECT_EQ(expected.empty(), owner[0] == 2);
  }
}

TEST(CrossBroadPhase, looks_at_no_geom_of_spaces_whose_boxes_stay_apart) {
  model::Model model = cloud(40, 2.5);
  for (std::size_t i = 0; i < model.bodies.size(); ++i)
    model.bodies[i].pose.position.x() += 100.0 * model.geoms[i + 1].space;
  const model::SpaceMap map = model::make_space_map(model);
  const auto poses = support::body_poses(model);
  std::vector<geometry::Box> boxes(num_spaces);
  for (int space = 0; space < num_spaces; ++space) {
    for (const int geom : map.geoms_of_space[space])
      boxes[space].include(geometry::geom_box(model.geoms[geom], poses[model.geoms[geom].body]));
  }
  const std::vector<int> owner = {0, 1, 2, 3, 4};
  std::vector<GeomPair> found;
  // The poses are not used, so there are none.
  const SpaceBodies bodies(model, map);
  CrossBroadPhase(model, bodies).find_pairs(owner, boxes, {}, found);
  EXPECT_TRUE(found.empty());
}

TEST(SpaceBodies, hold_all_geoms_of_a_space_in_its_box) {
  model::Model model = cloud(120, 2.5);
  model.geoms[7].local.position = {0.5, -0.3, 0.2};  // away from its body's centre
  const model::SpaceMap map = model::make_space_map(model);
  const SpaceBodies bodies(model, map);
  const auto poses = support::body_poses(model);
  std::size_t num_geoms = 0;
  for (int space = 0; space < num_spaces; ++space) {
    const geometry::Box box = bodies.space_box(space, poses);
    for (const int body : bodies.bodies(space)) {
      EXPECT_EQ(map.space_of_body(body), space);
      for (const int index : bodies.geoms(body)) {
        const geometry::Box geom = geometry::geom_box(model.geoms[index], poses[body]);
        ++num_geoms;
        for (std::size_t k = 0; k < 3; ++k) {
          EXPECT_LE(box.min[k], geom.min[k]);
          EXPECT_GE(box.max[k], geom.max[k]);
        }
      }
    }
  }
  EXPECT_EQ(num_geoms, model.geoms.size() - 1) << "all but the ground";
}

TEST(SorSpaceStepper, moves_a_subset_of_units_as_the_whole_world_does) {
  const auto model = std::make_shared<const model::Model>(support::crash());
  for (const stepping::Simd simd : machine_simds()) {
    stepping::StepperSettings settings = default_settings(stepping::StepperKind::sor, stepping::Law::ode);
    settings.simd = simd;
    const auto whole = make_stepper(settings, {*model});
    const auto world = make_sor_space_stepper(settings, ode::make_narrow_phase, model);
    const model::SpaceMap& map = world->map();
    const std::vector<int> own = {0};
    world->own(own, model::initial_state(*model), 0);
    std::vector<model::Contact> contacts, of_unit;
    core::PhaseTimes times;
    // Each unit alone in the same step, as if three ranks did it: the car is not there yet.
    for (std::int64_t step = 0; step < 4; ++step) {
      world->fire_events(step);
      world->collide(contacts);
      for (int unit = 0; unit < map.num_units(); ++unit) {
        of_unit.clear();
        for (const model::Contact& contact : contacts) {
          ASSERT_TRUE(contact.body_b == model::no_body ||
                      map.unit_of_body[contact.body_a] == map.unit_of_body[contact.body_b]);
          if (map.unit_of_body[contact.body_a] == unit) of_unit.push_back(contact);
        }
        world->solve(std::span(&unit, 1), of_unit, step, times);
        const stepping::Observables counts = world->count(std::span(&unit, 1));
        EXPECT_EQ(counts.islands, 1);
        EXPECT_EQ(counts.rows, counts.max_island_rows);
        EXPECT_GT(counts.rows, 0);
      }
      advance(*whole, 1);
      EXPECT_EQ(model::hash(world->state()), model::hash(whole->state(0))) << "step " << step;
    }
  }
}

TEST(SorSpaceStepper, takes_in_bodies_that_moved_elsewhere) {
  const auto model = std::make_shared<const model::Model>(support::crash());
  const auto settings = default_settings(stepping::StepperKind::sor, stepping::Law::ode);
  const auto here = make_sor_space_stepper(settings, ode::make_narrow_phase, model);
  const auto there = make_sor_space_stepper(settings, ode::make_narrow_phase, model);
  const std::vector<int> own = {0}, all = {0, 1, 2};
  for (const auto* world : {&here, &there}) (*world)->own(own, model::initial_state(*model), 0);
  std::vector<model::Contact> contacts;
  core::PhaseTimes times;
  std::vector<int> bodies;
  for (int body = 0; body < model->num_bodies(); ++body) bodies.push_back(body);
  for (std::int64_t step = 0; step < 40; ++step) {  // alternating between the two
    stepping::SpaceStepper& active = step % 2 == 0 ? *here : *there;
    stepping::SpaceStepper& other = step % 2 == 0 ? *there : *here;
    active.fire_events(step);
    active.collide(contacts);
    active.solve(all, contacts, step, times);
    std::vector<double> rows;
    const model::State& state = active.state();
    for (const int body : bodies) {
      const model::Quat& q = state.orientation[body];
      for (int k = 0; k < 3; ++k) rows.push_back(state.position[body][k]);
      rows.insert(rows.end(), {q.w, q.x, q.y, q.z});
      for (int k = 0; k < 3; ++k) rows.push_back(state.velocity[body][k]);
      for (int k = 0; k < 3; ++k) rows.push_back(state.angular_velocity[body][k]);
    }
    other.put_states(bodies, rows);
  }
  const auto whole = make_stepper(settings, {*model});
  advance(*whole, 40);
  EXPECT_EQ(model::hash(here->state()), model::hash(whole->state(0)));
  EXPECT_EQ(model::hash(there->state()), model::hash(whole->state(0)));
}

}  // namespace
}  // namespace pbmpi::solver
