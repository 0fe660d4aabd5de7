#include "ode/collide/contacts.h"

#include <gtest/gtest.h>

#include "ode/objects/bodies.h"
#include "ode/objects/engine.h"
#include "support/models.h"

namespace pbmpi::ode {
namespace {

using model::Model;
using model::Shape;

/// The touching pairs of a model at its initial poses.
class Collided {
 public:
  explicit Collided(const Model& model)
      : world_(dWorldCreate()),
        bodies_(make_bodies(world_.get(), model)),
        broad_(model, bodies_, SpaceKind::simple),
        contacts(model, effects::StepPlan(model), bodies_) {
    contacts.make(world_.get(), broad_.find_pairs(), broad_.geoms());
  }
  ~Collided() { contacts.clear(); }
  int num_joints(int body) const { return dBodyGetNumJoints(bodies_[body]); }

 private:
  Engine engine_;
  WorldHandle world_;
  std::vector<dBodyID> bodies_;
  BroadPhase broad_;

 public:
  Contacts contacts;
};

int num_contacts(const Collided& collided) { return stepping::count_contacts(collided.contacts.touches()); }

Model sunk_box(double depth) { return support::box_over_ground(-depth); }

TEST(Contacts, of_a_box_on_a_plane_are_its_corners) {
  Collided collided(sunk_box(0.01));
  EXPECT_EQ(num_contacts(collided), 4);
  EXPECT_EQ(collided.num_joints(0), 4);
  EXPECT_NEAR(collided.contacts.deepest_m(), 0.01, 1e-12);
  ASSERT_EQ(collided.contacts.touches().size(), 1u);
  EXPECT_EQ(collided.contacts.touches()[0].rows_per_contact, 3);
  collided.contacts.clear();
  EXPECT_EQ(collided.num_joints(0), 0);
}

TEST(Contacts, are_no_more_than_the_law_allows) {
  for (const int most : {1, 2, 3}) {
    Model model = sunk_box(0.01);
    model.contact_law.max_per_pair = most;
    EXPECT_EQ(num_contacts(Collided(model)), most);
  }
}

TEST(Contacts, with_a_smooth_geom_have_one_row) {
  Model model = sunk_box(0.01);
  model.geoms[1].material.mu = 0;  // sqrt(0.8 * 0) = 0, though the ground is rough
  Collided collided(model);
  EXPECT_EQ(collided.contacts.touches()[0].rows_per_contact, 1);
}

TEST(Contacts, find_every_pair_of_shapes) {
  struct Case {
    Shape shape;
    std::array<double, 3> size;
    double half_height;
  };
  const Case cases[] = {{Shape::sphere, {0.5, 0, 0}, 0.5},
                        {Shape::box, {1, 1, 1}, 0.5},
                        {Shape::capsule, {0.3, 0.4, 0}, 0.5},
                        {Shape::cylinder, {0.4, 1, 0}, 0.5}};
  for (const Case& lower : cases) {
    for (const Case& upper : cases) {
      Model model;
      const int actor = support::add_actor(model, "stack", model::ActorKind::prop, true);
      support::add_solid(model, actor, "lower", lower.shape, lower.size, 1, {0, 0, 0});
      support::add_solid(model, actor, "upper", upper.shape, upper.size, 1, {0.05, 0.02, 0.98});
      EXPECT_GT(num_contacts(Collided(model)), 0)
          << static_cast<int>(lower.shape) << " under " << static_cast<int>(upper.shape);
      model.bodies[1].pose.position.z() = 1.2;
      EXPECT_EQ(num_contacts(Collided(model)), 0);
    }
  }
}

TEST(Contacts, follow_the_geoms_offset_and_turn) {
  Model model;
  support::add_ground(model);
  const int actor = support::add_actor(model, "rod");
  support::add_solid(model, actor, "rod", Shape::capsule, {0.1, 2, 0}, 1, {0, 0, 0.5});
  EXPECT_EQ(num_contacts(Collided(model)), 1);  // upright: its lower end is 0.6 m under the ground
  model.geoms[1].local.orientation = support::rotation(model::Vec3::UnitX(), 1.5707963267948966);
  EXPECT_EQ(num_contacts(Collided(model)), 0);
  model.geoms[1].local.position = {0, 0, -0.45};
  EXPECT_EQ(num_contacts(Collided(model)), 2);  // a lying capsule touches with both ends
}

TEST(Contacts, with_a_plane_follow_its_pose) {
  Model model = support::box_over_ground(0.5);
  EXPECT_EQ(num_contacts(Collided(model)), 0);
  model.geoms[0].local.position = {3, -2, 0.51};
  EXPECT_EQ(num_contacts(Collided(model)), 4);
  model.geoms[0].local.orientation =
      support::rotation(model::Vec3::UnitY(), 1.5707963267948966);  // normal +x
  model.geoms[0].local.position = {-0.6, 0, 0};
  EXPECT_EQ(num_contacts(Collided(model)), 0);
  model.geoms[0].local.position = {-0.4, 0, 0};
  EXPECT_EQ(num_contacts(Collided(model)), 4);
}

}  // namespace
}  // namespace pbmpi::ode
