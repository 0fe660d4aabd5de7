#include "model/validate.h"

#include <cmath>
#include <functional>

#include <gtest/gtest.h>

#include "core/error.h"
#include "support/models.h"

namespace pbmpi::model {
namespace {

/// The message of validate() for the crash model after `spoil`; empty if it is valid.
std::string complaint(const std::function<void(Model&)>& spoil) {
  Model model = support::crash();
  model.events.emplace_back();
  model.events[0].body = 0;
  spoil(model);
  try {
    validate(model, "here.toml:3:1");
  } catch (const core::InputError& error) {
    return error.what();
  }
  return "";
}

struct Case {
  const char* name;
  std::function<void(Model&)> spoil;
  const char* part;  ///< of the message
};

const std::vector<Case>& cases() {
  static const std::vector<Case> all = {
      {"no body", [](Model& m) { m = Model{}; }, "no body"},
      {"mass 0", [](Model& m) { m.bodies[1].mass_kg = 0; }, "body 'car.wheel0': the mass"},
      {"mass NaN", [](Model& m) { m.bodies[1].mass_kg = NAN; }, "the mass"},
      {"mass infinite", [](Model& m) { m.bodies[1].mass_kg = infinity; }, "the mass"},
      {"mass too large", [](Model& m) { m.bodies[1].mass_kg = 1e31; }, "beyond 1e-30 to 1e30 kg"},
      {"mass too small", [](Model& m) { m.bodies[1].mass_kg = 1e-31; }, "beyond 1e-30 to 1e30 kg"},
      {"inertia too large", [](Model& m) { m.bodies[1].inertia *= 1e100; }, "beyond 1e-90 to 1e90 kg m^2"},
      {"inertia too small", [](Model& m) { m.bodies[1].inertia *= 1e-100; }, "beyond 1e-90 to 1e90 kg m^2"},
      {"air below 0", [](Model& m) { m.air_density = -1; }, "air of -1"},
      {"damping below 0", [](Model& m) { m.linear_damping = -1; }, "damping of -1"},
      {"release at the start", [](Model& m) { m.events[0].kind = EventKind::release, m.events[0].joint = 0; },
       "a joint is released at step 1 at the soonest"},
      {"pair of an actor that is not there",
       [](Model& m) {
         m.pair_materials = {{0, 99, {}}};
       },
       "actor 99 does not exist"},
      {"pair the wrong way round",
       [](Model& m) {
         m.pair_materials = {{1, 0, {}}};
       },
       "pair of actors 1 and 0: the lower actor comes first"},
      {"pair with a gain",
       [](Model& m) {
         m.pair_materials = {{0, 1, {0.5, 2}}};
       },
       "restitution in [0, 1]"},
      {"pairs out of order",
       [](Model& m) {
         m.pair_materials = {{0, 1, {}}, {0, 0, {}}};
       },
       "not in ascending order"},
      {"interest NaN",
       [](Model& m) {
         m.interest = Interest{{0, NAN, 0}};
       },
       "interest: the center"},
      {"interest's body",
       [](Model& m) {
         m.interest = Interest{{0, 0, 0}, 99};
       },
       "body 99 does not exist"},
      {"interest's radius",
       [](Model& m) {
         m.interest = Interest{{0, 0, 0}, 0, 0};
       },
       "radius"},
      {"interest's iterations",
       [](Model& m) {
         m.interest = Interest{{0, 0, 0}, 0, 1, 0};
       },
       "at least 1"},
      {"damping NaN", [](Model& m) { m.angular_damping = NAN; }, "damping of nan"},
      {"inertia skew", [](Model& m) { m.bodies[0].inertia(0, 1) += 1; }, "symmetric"},
      {"inertia NaN", [](Model& m) { m.bodies[0].inertia(0, 0) = NAN; }, "inertia"},
      {"inertia negative", [](Model& m) { m.bodies[0].inertia(2, 2) = -1; }, "positive definite"},
      {"pose NaN", [](Model& m) { m.bodies[0].pose.position.x() = NAN; }, "pose is not finite"},
      {"turn NaN", [](Model& m) { m.bodies[0].pose.orientation.w = NAN; }, "pose is not finite"},
      {"turn long", [](Model& m) { m.bodies[0].pose.orientation.w = 1.001; }, "unit quaternion"},
      {"velocity NaN", [](Model& m) { m.bodies[0].velocity.y() = NAN; }, "velocity is not finite"},
      {"spin infinite", [](Model& m) { m.bodies[0].angular_velocity.y() = infinity; }, "velocity"},
      {"body's actor", [](Model& m) { m.bodies[0].actor = 99; }, "actor 99 does not exist"},
      {"same name", [](Model& m) { m.bodies[1].name = m.bodies[0].name; }, "'car.chassis' exists twice"},
      {"geom's body", [](Model& m) { m.geoms[2].body = 37; }, "geom 2: body 37 does not exist"},
      {"geom's actor", [](Model& m) { m.geoms[2].actor = -1; }, "actor -1"},
      {"geom's space", [](Model& m) { m.geoms[2].space = 1; }, "space 1"},
      {"size 0", [](Model& m) { m.geoms[0].size[2] = 0; }, "size"},
      {"size NaN", [](Model& m) { m.geoms[0].size[0] = NAN; }, "size"},
      {"moving plane", [](Model& m) { m.geoms.back().body = 0; }, "plane"},
      {"mu negative", [](Model& m) { m.geoms[0].material.mu = -1; }, "mu"},
      {"restitution 2", [](Model& m) { m.geoms[0].material.restitution = 2; }, "restitution"},
      {"joint's a", [](Model& m) { m.joints[0].body_a = no_body; }, "joint 'joint0': body -1"},
      {"joint's b", [](Model& m) { m.joints[0].body_b = 50; }, "body 50"},
      {"joint with itself", [](Model& m) { m.joints[0].body_b = m.joints[0].body_a; }, "itself"},
      {"anchor NaN", [](Model& m) { m.joints[0].anchor_b.z() = NAN; }, "anchor"},
      {"axis long", [](Model& m) { m.joints[0].axis1_a *= 2; }, "axis is not a unit"},
      {"limits swapped",
       [](Model& m) {
         m.joints[0].limits[0] = {1, -1};
       },
       "above high"},
      {"limit NaN", [](Model& m) { m.joints[0].limits[0].low = NAN; }, "limit"},
      {"motor NaN", [](Model& m) { m.joints[0].motors[0].velocity = NAN; }, "motor"},
      {"motor pushes back", [](Model& m) { m.joints[0].motors[0].max_force = -1; }, "motor"},
      {"motor held backwards", [](Model& m) { m.joints[0].motors[0].hold_rate = -1; }, "hold_rate"},
      {"axle held",
       [](Model& m) {
         m.joints[0].kind = JointKind::hinge2;
         m.joints[0].motors[1] = {0, 1, 5};
       },
       "no pose to hold"},
      {"spring negative", [](Model& m) { m.joints[0].suspension.damping = -1; }, "spring"},
      {"event too early", [](Model& m) { m.events[0].step = -1; }, "event 0: it is scheduled at step -1"},
      {"event's body", [](Model& m) { m.events[0].body = 37; }, "body 37"},
      {"launch NaN", [](Model& m) { m.events[0].velocity.x() = NAN; }, "launch velocity"},
      {"event's joint", [](Model& m) { m.events[0].kind = EventKind::motor; }, "joint -1"},
      {"event's axis",
       [](Model& m) {
         m.events[0].kind = EventKind::motor;
         m.events[0].joint = 0;
         m.events[0].axis = 2;
       },
       "axis 2"},
      {"joint of a strength below none", [](Model& m) { m.joints[0].break_force = -1; }, "-1.0"},
      {"joint of torque NaN", [](Model& m) { m.joints[0].break_torque = NAN; }, "N m"},
      {"gravity NaN", [](Model& m) { m.gravity.x() = NAN; }, "gravity"},
      {"erp 2", [](Model& m) { m.erp = 2; }, "erp"},
      {"cfm negative", [](Model& m) { m.cfm = -1; }, "cfm"},
      {"sleep at a speed below none", [](Model& m) { m.sleep.speed = -1; }, "speeds"},
      {"sleep spins NaN", [](Model& m) { m.sleep.angular_speed = NAN; }, "speeds"},
      {"sleep at once", [](Model& m) { m.sleep.after_s = 0; }, "after a time"},
      {"no contacts", [](Model& m) { m.contact_law.max_per_pair = 0; }, "max_per_pair"},
  };
  return all;
}

TEST(Validate, accepts_the_crash_model) {
  EXPECT_EQ(complaint([](Model&) {}), "");
}

TEST(Validate, names_the_place_and_the_thing_of_each_mistake) {
  for (const Case& wrong : cases()) {
    const std::string message = complaint(wrong.spoil);
    EXPECT_EQ(message.rfind("here.toml:3:1", 0), 0u) << wrong.name << ": " << message;
    EXPECT_NE(message.find(wrong.part), std::string::npos) << wrong.name << ": " << message;
  }
}

TEST(Validate, gives_the_actor_of_what_is_wrong) {
  Model model = support::crash();
  model.bodies.back().mass_kg = -1;
  try {
    validate(model, "here");
    FAIL() << "nothing is thrown";
  } catch (const ActorError& error) {
    EXPECT_EQ(static_cast<int>(error.actor()), model.bodies.back().actor);
  }
}

TEST(Validate, allows_a_quaternion_that_is_a_rounding_off_unit_length) {
  EXPECT_EQ(complaint([](Model& m) { m.bodies[0].pose.orientation.w = 1 + 1e-15; }), "");
}

}  // namespace
}  // namespace pbmpi::model
