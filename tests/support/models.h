/// Small models for tests and benchmarks: functions to build one, and a few complete ones.
#pragma once

#include <string>
#include <vector>

#include "model/model.h"

namespace pbmpi::support {

using model::Model;
using model::Quat;
using model::Vec3;

/// A rotation by `angle` [rad] about the unit vector `axis`.
Quat rotation(const Vec3& axis, double angle);

/// Each of these functions returns the index of what it has added.
int add_actor(Model& model, const std::string& name, model::ActorKind kind = model::ActorKind::prop,
              bool self_collision = false);
/// A homogeneous body of that shape (sizes as in model::Geom) with a geom centred on it.
int add_solid(Model& model, int actor, const std::string& name, model::Shape shape,
              const std::array<double, 3>& size, double mass_kg, const Vec3& position, const Quat& turn = {});
/// The plane z = 0, static.
int add_ground(Model& model);
/// The indices of a model's geoms.
std::vector<int> all_geoms(const Model& model);
/// Anchor and axes in the world frame, at the bodies' initial poses; body_b may be no_body.
int add_joint(Model& model, model::JointKind kind, int body_a, int body_b, const Vec3& anchor,
              const Vec3& axis1 = Vec3::UnitZ(), const Vec3& axis2 = Vec3::UnitX());

/// A box of 2 x 1 x 0.5 m and 3 kg, turned and spinning, 10 m up; no ground.
Model free_box();
/// A cube of 1 m and 10 kg, `height` [m] between its lower side and the ground.
Model box_over_ground(double height);
/// A ball of 1 kg and radius 0.3 m, held by a hinge (axis y) at the origin, `length` [m] away, `angle` [rad]
/// off the vertical.
Model pendulum(double length, double angle);
/// `num_links` rods of 0.5 m and 1 kg, hung on the world by ball joints, stretched along x.
Model chain(int num_links);
/// `num_boxes` cubes of 0.5 m, slightly turned and shifted, one above the other above the ground: they fall
/// into a pile.
Model pile(int num_boxes);
/// `a_side`^3 balls of 0.3 m and 1 kg above the ground, slightly apart and out of line: they fall and meet.
/// `mu`: that of all balls and the ground; `variant` moves them slightly.
Model falling_balls(int a_side, double mu, int variant = 0);
/// A car of 5 bodies that drives at 25 m/s into two 16-body ragdolls, 3 m ahead; 37 bodies, 34 joints of all
/// kinds except slider, contacts from the first step. `variant` moves the ragdolls slightly.
Model crash(int variant = 0);

}  // namespace pbmpi::support
