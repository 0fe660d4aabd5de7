#include "model/validate.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <optional>
#include <set>
#include <string>
#include <utility>

#include <Eigen/Eigenvalues>

#include "core/error.h"
#include "core/quantity.h"
#include "model/joint_traits.h"
#include "model/shape_traits.h"

namespace pbmpi::model {
namespace {

using core::require_input;

constexpr double unit_tolerance = 1e-9;  // for lengths that should be 1; normalising rounds by 1e-16

/// [kg m^2] of the largest mass and size, and of the smallest.
constexpr double most_inertia = core::largest_number * core::largest_number * core::largest_number;
constexpr double least_inertia = core::smallest_number * core::smallest_number * core::smallest_number;

bool is_finite(const Quat& q) {
  return std::isfinite(q.w) && std::isfinite(q.x) && std::isfinite(q.y) && std::isfinite(q.z);
}

void require_pose(const Pose& pose, const std::string& who) {
  require_input(pose.position.allFinite() && is_finite(pose.orientation),
                who + ": the pose is not finite; give numbers");
  const double norm = pose.orientation.to_eigen().norm();
  require_input(std::abs(norm - 1) <= unit_tolerance,
                who + ": the orientation is not a unit quaternion; normalise it");
}

std::optional<std::string> index_fault(int index, std::size_t count, const char* what) {
  if (index >= 0 && static_cast<std::size_t>(index) < count) return std::nullopt;
  return std::string(what) + " " + std::to_string(index) + " does not exist; there are " +
         std::to_string(count);
}

void require_index(int index, std::size_t count, const std::string& who, const char* what) {
  if (const auto fault = index_fault(index, count, what)) throw core::InputError(who + ": " + *fault);
}

void validate_body(const Model& model, const Body& body, const std::string& who) {
  require_index(body.actor, model.actors.size(), who, "actor");
  require_input(std::isfinite(body.mass_kg) && body.mass_kg > 0,
                who + ": the mass is " + std::to_string(body.mass_kg) + " kg; it must be finite and above 0");
  require_input(body.mass_kg >= core::smallest_number && body.mass_kg <= core::largest_number,
                who +
                    ": the mass is beyond 1e-30 to 1e30 kg, whose products the solver can carry; check the "
                    "density and sizes");
  require_input(body.inertia.allFinite() && body.inertia.isApprox(body.inertia.transpose(), unit_tolerance),
                who + ": the inertia is not a symmetric finite matrix");
  const Eigen::SelfAdjointEigenSolver<Mat3> eigen(body.inertia, Eigen::EigenvaluesOnly);
  require_input(eigen.eigenvalues().minCoeff() > 0,
                who + ": the inertia is not positive definite; check the mass and sizes");
  require_input(
      eigen.eigenvalues().minCoeff() >= least_inertia && eigen.eigenvalues().maxCoeff() <= most_inertia,
      who +
          ": the inertia is beyond 1e-90 to 1e90 kg m^2, whose products the solver can carry; "
          "check the mass and sizes");
  require_pose(body.pose, who);
  require_input(body.velocity.allFinite() && body.angular_velocity.allFinite(),
                who + ": the velocity is not finite");
}

void require_material(const Material& material, const std::string& who) {
  require_input(material.mu >= 0 && material.restitution >= 0 && material.restitution <= 1,
                who + ": mu must be at least 0 and restitution in [0, 1]");
}

void validate_geom(const Model& model, const Geom& geom, const std::string& who) {
  if (geom.body != no_body) require_index(geom.body, model.bodies.size(), who, "body");
  require_index(geom.actor, model.actors.size(), who, "actor");
  require_index(geom.space, model.spaces.size(), who, "space");
  require_pose(geom.local, who);
  for (int i = 0; i < traits_of(geom.shape).num_sizes; ++i) {
    require_input(std::isfinite(geom.size[i]) && geom.size[i] > 0,
                  who + ": size " + std::to_string(geom.size[i]) + " m must be finite and above 0");
  }
  require_input(geom.shape != Shape::hull || geom.hull != nullptr, who + ": a hull without its points");
  require_input(geom.shape != Shape::mesh || (geom.hull != nullptr && geom.mesh != nullptr),
                who + ": a mesh without its triangles");
  require_input(
      geom.shape != Shape::mesh || geom.body == no_body,
      who + ": a mesh of triangles encloses nothing and cannot belong to a body; give the body a hull");
  require_input(geom.shape != Shape::plane || geom.body == no_body,
                who + ": a plane cannot belong to a body");
  require_material(geom.material, who);
}

void validate_pair_materials(const Model& model, const std::string& where) {
  const auto actors_of = [](const PairMaterial& one) { return std::pair(one.actor_a, one.actor_b); };
  for (const PairMaterial& pair : model.pair_materials) {
    const std::string who =
        where + ": pair of actors " + std::to_string(pair.actor_a) + " and " + std::to_string(pair.actor_b);
    require_index(pair.actor_a, model.actors.size(), who, "actor");
    require_index(pair.actor_b, model.actors.size(), who, "actor");
    require_input(pair.actor_a <= pair.actor_b, who + ": the lower actor comes first; swap them");
    require_material(pair.material, who);
  }
  const auto later = std::ranges::adjacent_find(model.pair_materials, std::greater_equal{}, actors_of);
  require_input(later == model.pair_materials.end(),
                where + ": the pairs of actors are not in ascending order, each once; sort them");
}

/// What is wrong with a motor, or nothing.
std::optional<std::string> fault_of(const AxisMotor& motor, const AxisTraits& axis) {
  if (!(std::isfinite(motor.velocity) && motor.max_force >= 0))
    return "a motor needs a finite velocity and max_force >= 0";
  if (!(std::isfinite(motor.hold_rate) && motor.hold_rate >= 0))
    return "a motor needs a finite hold_rate >= 0";
  const bool is_axle = axis.has_motor && !axis.has_limit;
  if (is_axle && motor.hold_rate != 0)
    return "a hinge2's axle turns without end and has no pose to hold; remove hold_rate";
  return std::nullopt;
}

void validate_joint(const Model& model, const Joint& joint, const std::string& who) {
  require_index(joint.body_a, model.bodies.size(), who, "body");
  if (joint.body_b != no_body) require_index(joint.body_b, model.bodies.size(), who, "body");
  require_input(joint.body_a != joint.body_b, who + ": it joins a body to itself; name two bodies");
  require_input(joint.anchor_a.allFinite() && joint.anchor_b.allFinite(), who + ": an anchor is not finite");
  require_input(std::abs(joint.axis1_a.norm() - 1) <= unit_tolerance &&
                    std::abs(joint.axis2_b.norm() - 1) <= unit_tolerance,
                who + ": an axis is not a unit vector; normalise it");
  for (const AxisLimit& limit : joint.limits) {
    require_input(limit.low <= limit.high, who + ": the limit low = " + std::to_string(limit.low) +
                                               " is above high = " + std::to_string(limit.high) +
                                               "; swap them");
  }
  for (std::size_t axis = 0; axis < joint.motors.size(); ++axis) {
    if (const auto fault = fault_of(joint.motors[axis], traits_of(joint.kind).axes[axis]))
      throw core::InputError(who + ": " + *fault);
  }
  require_input(joint.suspension.stiffness >= 0 && joint.suspension.damping >= 0,
                who + ": a spring needs stiffness and damping >= 0");
  require_input(joint.break_force >= 0 && joint.break_torque >= 0,
                who + ": it breaks at " + std::to_string(joint.break_force) + " N or " +
                    std::to_string(joint.break_torque) + " N m; give at least 0, which is never");
}

/// What is wrong with an event, or nothing. Builds no text where nothing is wrong: a one-hour programme has a
/// million events.
std::optional<std::string> fault_of(const Model& model, const Event& event) {
  if (event.step < 0)
    return "it is scheduled at step " + std::to_string(event.step) + "; the first step is 0";
  if (event.kind == EventKind::launch) {
    if (auto fault = index_fault(event.body, model.bodies.size(), "body")) return fault;
    if (!event.velocity.allFinite() || !event.angular_velocity.allFinite())
      return "the launch velocity is not finite";
    if (event.pose && !(event.pose->position.allFinite() &&
                        std::abs(event.pose->orientation.to_eigen().norm() - 1) <= unit_tolerance))
      return "the launch pose is not finite or its quaternion not of unit length";
    return std::nullopt;
  }
  if (auto fault = index_fault(event.joint, model.joints.size(), "joint")) return fault;
  const Joint& joint = model.joints[event.joint];
  if (event.kind == EventKind::release) {
    if (event.step >= 1) return std::nullopt;
    return "a joint is released at step 1 at the soonest; leave the joint '" + joint.name + "' out instead";
  }
  if (auto fault = index_fault(event.axis, 2, "axis")) return fault;
  return fault_of(event.motor, traits_of(joint.kind).axes[static_cast<std::size_t>(event.axis)]);
}

void validate_interest(const Model& model, const Interest& interest, const std::string& who) {
  require_input(interest.center.allFinite(), who + ": the center is not finite; give numbers");
  if (interest.follows != no_body) require_index(interest.follows, model.bodies.size(), who, "body");
  require_input(interest.radius_m > 0, who + ": the radius must be above 0 m");
  require_input(interest.outside_iterations >= 1, who + ": the solver needs at least 1 iteration outside");
}

/// Runs a check; what it throws has the actor, if there is one of this index.
template <class Check>
void check_of_actor(const Model& model, int actor, Check check) {
  try {
    check();
  } catch (const core::InputError& error) {
    if (index_fault(actor, model.actors.size(), "actor")) throw;
    throw ActorError(error.what(), static_cast<std::size_t>(actor));
  }
}

constexpr int no_actor = -1;

int actor_of_body(const Model& model, int body) {
  return index_fault(body, model.bodies.size(), "body") ? no_actor : model.bodies[body].actor;
}

/// None of a joint between two actors, which is the scene's.
int actor_of(const Model& model, const Joint& joint) {
  const int actor = actor_of_body(model, joint.body_a);
  return joint.body_b == no_body || actor_of_body(model, joint.body_b) == actor ? actor : no_actor;
}

int actor_of(const Model& model, const Event& event) {
  if (event.kind == EventKind::launch) return actor_of_body(model, event.body);
  if (index_fault(event.joint, model.joints.size(), "joint")) return no_actor;
  return actor_of(model, model.joints[event.joint]);
}

void validate_world(const Model& model, const std::string& where) {
  require_input(!model.bodies.empty(),
                where + ": the world has no body; place an actor that moves, such as a model with a mass");
  require_input(model.gravity.allFinite(), where + ": gravity is not finite");
  require_input(std::isfinite(model.erp) && model.erp >= 0 && model.erp <= 1,
                where + ": erp must lie in [0, 1]");
  require_input(std::isfinite(model.cfm) && model.cfm >= 0, where + ": cfm must be at least 0");
  for (const double damping : {model.linear_damping, model.angular_damping}) {
    require_input(std::isfinite(damping) && damping >= 0,
                  where + ": damping of " + std::to_string(damping) + " 1/s; it must be finite, 0 or above");
  }
  require_input(std::isfinite(model.air_density) && model.air_density >= 0,
                where + ": air of " + std::to_string(model.air_density) +
                    " kg/m^3; its density must be finite, 0 or above");
  require_input(std::isfinite(model.sleep.speed) && model.sleep.speed >= 0 &&
                    std::isfinite(model.sleep.angular_speed) && model.sleep.angular_speed >= 0,
                where + ": the speeds below which islands fall asleep must be at least 0");
  require_input(std::isfinite(model.sleep.after_s) && model.sleep.after_s > 0,
                where + ": islands fall asleep after a time above 0 s");
  if (model.interest) validate_interest(model, *model.interest, where + ": interest");
  constexpr int most_per_pair = 65535;  // dCollide() takes the number in 16 bits
  require_input(model.contact_law.max_per_pair >= 1 && model.contact_law.max_per_pair <= most_per_pair,
                where + ": max_per_pair is " + std::to_string(model.contact_law.max_per_pair) +
                    "; it must be between 1 and " + std::to_string(most_per_pair));
}

}  // namespace

void validate(const Model& model, const std::string& where) {
  validate_world(model, where);
  std::set<std::string> names;
  for (const Body& body : model.bodies) {
    check_of_actor(model, body.actor, [&] {
      const std::string who = where + ": body '" + body.name + "'";
      require_input(names.insert(body.name).second, who + " exists twice; give each body its own name");
      validate_body(model, body, who);
    });
  }
  for (std::size_t i = 0; i < model.geoms.size(); ++i) {
    const Geom& geom = model.geoms[i];
    check_of_actor(model, geom.actor,
                   [&] { validate_geom(model, geom, where + ": geom " + std::to_string(i)); });
  }
  validate_pair_materials(model, where);
  for (const Joint& joint : model.joints) {
    check_of_actor(model, actor_of(model, joint),
                   [&] { validate_joint(model, joint, where + ": joint '" + joint.name + "'"); });
  }
  for (std::size_t i = 0; i < model.events.size(); ++i) {
    check_of_actor(model, actor_of(model, model.events[i]), [&] {
      if (const auto fault = fault_of(model, model.events[i]))
        throw core::InputError(where + ": event " + std::to_string(i) + ": " + *fault);
    });
  }
}

void require_kind_has(const Joint& joint) {
  const JointTraits& traits = traits_of(joint.kind);
  for (int axis = 0; axis < 2; ++axis) {
    require_input(traits.axes[axis].has_motor || !joint.motors[axis].active(),
                  "joint '" + joint.name + "': it has a motor on axis " + std::to_string(axis + 1) +
                      ", which its kind does not have; remove the motor");
    require_input(traits.axes[axis].has_limit || !joint.limits[axis].active(),
                  "joint '" + joint.name + "': it has a limit on axis " + std::to_string(axis + 1) +
                      ", which its kind cannot limit; remove the limit");
  }
  require_input(
      !traits.needs_two_bodies || joint.body_b != no_body,
      "joint '" + joint.name + "': a " + std::string(traits.name) + " needs two bodies; name the second");
}

}  // namespace pbmpi::model
