#include "support/hard_models.h"

#include <string>

#include "support/models.h"

namespace pbmpi::support {

using model::JointKind;
using model::Shape;

Model loaded_chain(int num_links, double load_kg) {
  constexpr double length_m = 0.2;
  Model model;
  const int actor = add_actor(model, "chain");
  int before = model::no_body;
  for (int i = 0; i < num_links; ++i) {
    const Vec3 middle(length_m * (i + 0.5), 0, 10);
    const int link =
        add_solid(model, actor, "link" + std::to_string(i), Shape::box, {length_m, 0.05, 0.05}, 1, middle);
    const int joint = add_joint(model, JointKind::ball, link, before, {length_m * i, 0, 10});
    model.joints[static_cast<std::size_t>(joint)].name = "joint" + std::to_string(i);
    before = link;
  }
  const Vec3 end(length_m * num_links, 0, 10);
  const int load = add_solid(model, actor, "load", Shape::sphere, {0.2}, load_kg, end);
  const int joint = add_joint(model, JointKind::ball, load, before, end);
  model.joints[static_cast<std::size_t>(joint)].name = "hook";
  return model;
}

Model elastic_balls(int num_balls) {
  Model model;
  add_ground(model);
  for (int i = 0; i < num_balls; ++i) {
    const std::string name = "ball" + std::to_string(i);
    const int layer = i / 8, in_layer = i % 8;
    // Layers are shifted, so that balls meet off centre.
    const Vec3 position(0.45 * (in_layer % 4) + 0.05 * layer, 0.45 * (in_layer / 4) + 0.07 * layer,
                        5 + 0.5 * layer);
    add_solid(model, add_actor(model, name), name, Shape::sphere, {0.2}, 4, position);
  }
  for (model::Geom& geom : model.geoms) geom.material = {0, 1};
  return model;
}

Model balls_over_plate(double height) {
  Model model;
  add_ground(model);
  model::Geom plate;
  plate.actor = add_actor(model, "plate", model::ActorKind::wall);
  plate.shape = Shape::box;
  plate.size = {8, 8, 0.02};
  plate.local.position = {0, 0, 1};
  model.geoms.push_back(plate);
  for (int i = 0; i < 10; ++i) {
    const std::string name = "ball" + std::to_string(i);
    const Vec3 position(0.6 * (i % 5) - 1.2, 0.6 * (i / 5), height + 0.037 * i);
    add_solid(model, add_actor(model, name), name, Shape::sphere, {0.2}, 4, position);
  }
  return model;
}

Model motor_at_limit(double torque) {
  Model model;
  const int actor = add_actor(model, "arm", model::ActorKind::prop, true);
  const int base = add_solid(model, actor, "base", Shape::box, {0.2, 0.2, 0.2}, 5, {0, 0, 2});
  const int arm = add_solid(model, actor, "arm", Shape::box, {1, 0.1, 0.1}, 3, {0.6, 0, 2});
  add_joint(model, JointKind::ball, base, model::no_body, {0, 0, 2});
  const int hinge = add_joint(model, JointKind::hinge, arm, base, {0.1, 0, 2}, Vec3::UnitY());
  model::Joint& driven = model.joints[static_cast<std::size_t>(hinge)];
  driven.name = "shoulder";
  driven.limits[0] = {-0.5, 0.5};
  driven.motors[0] = {.velocity = 20, .max_force = torque};
  return model;
}

Model overlapping_cubes(double offset) {
  Model model;
  add_ground(model);
  for (const auto& [name, x, z] :
       {std::tuple("lower", 0.0, 0.25), std::tuple("upper", 0.02, 0.3), std::tuple("third", 2.0, 0.25)}) {
    add_solid(model, add_actor(model, name), name, Shape::box, {0.5, 0.5, 0.5}, 10, {x + offset, 0, z});
  }
  return model;
}

}  // namespace pbmpi::support
