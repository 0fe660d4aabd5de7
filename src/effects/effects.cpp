#include "effects/effects.h"

#include <algorithm>

#include <fmt/core.h>

#include "core/error.h"
#include "effects/drag.h"

namespace pbmpi::effects {
namespace {

using core::Phase;

/// "3 geoms with mu > 0", or nothing for none.
std::optional<Reason> counted(std::ptrdiff_t count, std::string_view what) {
  if (count == 0) return std::nullopt;
  return Reason{count, std::string(what)};
}

template <class Items, class Predicate>
std::optional<Reason> counted_if(const Items& items, Predicate predicate, std::string_view what) {
  return counted(std::count_if(items.begin(), items.end(), predicate), what);
}

template <class Predicate>
std::optional<Reason> counted_events(const model::Model& model, Predicate predicate, std::string_view what) {
  return counted_if(model.events, predicate, what);
}

std::optional<Reason> gravity(const model::Model& model) {
  if (model.gravity.isZero()) return std::nullopt;
  return counted(model.num_bodies(), fmt::format("bodies under {:g} m/s^2", model.gravity.norm()));
}

std::optional<Reason> collision(const model::Model& model) {
  if (is_left_out(model, EffectId::collision)) return std::nullopt;
  const bool moving = std::any_of(model.geoms.begin(), model.geoms.end(),
                                  [](const model::Geom& g) { return g.body != model::no_body; });
  if (!moving || model.geoms.size() < 2) return std::nullopt;
  return counted(static_cast<std::ptrdiff_t>(model.geoms.size()), "geoms");
}

std::optional<Reason> friction(const model::Model& model) {
  if (!collision(model)) return std::nullopt;
  const auto rubs = [](const auto& one) { return one.material.mu > 0; };
  if (auto reason = counted_if(model.geoms, rubs, "geoms with mu > 0")) return reason;
  return counted_if(model.pair_materials, rubs, "pairs of actors with mu > 0");
}

std::optional<Reason> restitution(const model::Model& model) {
  if (!collision(model)) return std::nullopt;
  const auto bounces = [](const auto& one) { return one.material.restitution > 0; };
  if (auto reason = counted_if(model.geoms, bounces, "geoms with restitution > 0")) return reason;
  return counted_if(model.pair_materials, bounces, "pairs of actors with restitution > 0");
}

/// Counts the spaces in which a body moves.
std::optional<Reason> cross_space(const model::Model& model) {
  if (!collision(model)) return std::nullopt;
  std::vector<bool> in_use(model.spaces.size(), false);
  for (const model::Geom& geom : model.geoms) {
    if (geom.body != model::no_body) in_use[static_cast<std::size_t>(geom.space)] = true;
  }
  const auto count = std::count(in_use.begin(), in_use.end(), true);
  return counted(count > 1 ? count : 0, "collision spaces with bodies");
}

std::optional<Reason> fast_bodies(const model::Model& model) {
  if (!collision(model)) return std::nullopt;
  return counted_if(
      model.geoms, [](const model::Geom& g) { return g.body != model::no_body; },
      "moving geoms, armed in steps in which one moves by more than half its extent");
}

std::optional<Reason> field_of_interest(const model::Model& model) {
  if (!model.interest) return std::nullopt;
  const model::Interest& interest = *model.interest;
  const model::Vec3& c = interest.center;
  const std::string middle =
      interest.follows == model::no_body
          ? fmt::format("[{:g}, {:g}, {:g}]", c.x(), c.y(), c.z())
          : fmt::format("'{}'", model.bodies[static_cast<std::size_t>(interest.follows)].name);
  return Reason{0, fmt::format("within {:g} m of {}; elsewhere at most {} {}", interest.radius_m, middle,
                               interest.outside_iterations,
                               interest.outside_iterations == 1 ? "iteration" : "iterations")};
}

std::optional<Reason> joints(const model::Model& model) {
  return counted(static_cast<std::ptrdiff_t>(model.joints.size()), "joints");
}

std::optional<Reason> limits(const model::Model& model) {
  return counted_if(
      model.joints, [](const model::Joint& j) { return j.limits[0].active() || j.limits[1].active(); },
      "joints with a limit");
}

std::optional<Reason> motors(const model::Model& model) {
  const auto has_motor = [](const model::Joint& j) { return j.motors[0].active() || j.motors[1].active(); };
  if (auto reason = counted_if(model.joints, has_motor, "joints with a motor")) return reason;
  return counted_events(
      model, [](const model::Event& e) { return e.kind == model::EventKind::motor; }, "motor events");
}

std::optional<Reason> suspension(const model::Model& model) {
  return counted_if(
      model.joints, [](const model::Joint& j) { return j.suspension.stiffness > 0; }, "joints with a spring");
}

std::optional<Reason> breakable_joints(const model::Model& model) {
  const auto breakable = [](const model::Joint& j) { return j.breakable(); };
  if (auto reason = counted_if(model.joints, breakable, "joints with a strength")) return reason;
  return counted_events(
      model, [](const model::Event& e) { return e.kind == model::EventKind::release; }, "releases of joints");
}

std::optional<Reason> steering(const model::Model& model) {
  return counted_events(
      model, [](const model::Event& e) { return e.kind == model::EventKind::steer; }, "steering events");
}

std::optional<Reason> drag(const model::Model& model) {
  if (model.air_density == 0) return std::nullopt;
  return counted(model.num_bodies(), fmt::format("bodies in air of {:g} kg/m^3", model.air_density));
}

std::optional<Reason> launches(const model::Model& model) {
  return counted_events(
      model, [](const model::Event& e) { return e.kind == model::EventKind::launch; }, "launches");
}

std::optional<Reason> gyroscopic_torque(const model::Model& model) {
  return counted_if(model.bodies, has_gyroscopic_torque, "bodies whose inertia differs by axis");
}

std::optional<Reason> damping(const model::Model& model) {
  if (model.linear_damping == 0 && model.angular_damping == 0) return std::nullopt;
  return counted(model.num_bodies(), fmt::format("bodies at {:g} 1/s linear, {:g} 1/s angular",
                                                 model.linear_damping, model.angular_damping));
}

/// Sleeping is an approximation, so a model has it only on explicit request.
std::optional<Reason> sleeping(const model::Model& model) {
  if (choice_of(model, EffectId::sleeping) != std::optional<bool>(true)) return std::nullopt;
  return Reason{0, fmt::format("after {:g} s below {:g} m/s and {:g} rad/s", model.sleep.after_s,
                               model.sleep.speed, model.sleep.angular_speed)};
}

template <model::EventKind kind>
void drop_events(model::Model& model) {
  std::erase_if(model.events, [](const model::Event& e) { return e.kind == kind; });
}

void keep(model::Model&) {}
void drop_gravity(model::Model& model) { model.gravity.setZero(); }
void drop_friction(model::Model& model) {
  for (model::Geom& geom : model.geoms) geom.material.mu = 0;
  for (model::PairMaterial& pair : model.pair_materials) pair.material.mu = 0;
}
void drop_restitution(model::Model& model) {
  for (model::Geom& geom : model.geoms) geom.material.restitution = 0;
  for (model::PairMaterial& pair : model.pair_materials) pair.material.restitution = 0;
}
void drop_interest(model::Model& model) { model.interest.reset(); }
void drop_spaces(model::Model& model) {
  model.spaces.resize(1);
  for (model::Geom& geom : model.geoms) geom.space = 0;
}
void drop_limits(model::Model& model) {
  for (model::Joint& joint : model.joints) joint.limits = {};
}
void drop_motors(model::Model& model) {
  for (model::Joint& joint : model.joints) joint.motors = {};
  drop_events<model::EventKind::motor>(model);
}
void drop_suspension(model::Model& model) {
  for (model::Joint& joint : model.joints) joint.suspension = {};
}
void drop_breaks(model::Model& model) {
  for (model::Joint& joint : model.joints) joint.break_force = joint.break_torque = 0;
  drop_events<model::EventKind::release>(model);
}
void drop_air(model::Model& model) { model.air_density = 0; }
void drop_damping(model::Model& model) { model.linear_damping = model.angular_damping = 0; }
void refuse_without_joints(model::Model& model) {
  core::require_input(model.joints.empty(),
                      "effect 'joints' cannot be left out: " + std::to_string(model.joints.size()) +
                          " joints hold the bodies of this world together; take them out of the scene");
}

}  // namespace

const std::vector<Effect>& effect_registry() {
  static const std::vector<Effect> effects = {
      {EffectId::events, "events", "bodies are launched at given steps", Phase::integrate, launches,
       drop_events<model::EventKind::launch>},
      {EffectId::steering, "steering", "joint axes are pinned to angles at given steps", Phase::integrate,
       steering, drop_events<model::EventKind::steer>},
      {EffectId::drag, "drag", "the air slows bodies down", Phase::integrate, drag, drop_air, make_drag},
      {EffectId::collision, "collision", "geoms that touch get contacts", Phase::collide, collision, keep},
      {EffectId::cross_space, "cross_space", "contacts between collision spaces are told apart",
       Phase::collide, cross_space, drop_spaces},
      {EffectId::fast_bodies, "fast_bodies", "contacts ahead keep fast geoms from passing through others",
       Phase::collide, fast_bodies, keep},
      {EffectId::field_of_interest, "field_of_interest", "islands get all iterations only near a point",
       Phase::islands, field_of_interest, drop_interest},
      {EffectId::friction, "friction", "contacts resist sliding (Coulomb)", Phase::rows, friction,
       drop_friction},
      {EffectId::restitution, "restitution", "contacts bounce", Phase::rows, restitution, drop_restitution},
      {EffectId::joints, "joints", "bodies are held together", Phase::rows, joints, refuse_without_joints},
      {EffectId::limits, "limits", "joint angles stay in their range", Phase::rows, limits, drop_limits},
      {EffectId::motors, "motors", "joint axes are driven or held", Phase::rows, motors, drop_motors},
      {EffectId::suspension, "suspension", "wheels spring along the steering axis", Phase::rows, suspension,
       drop_suspension},
      {EffectId::breakable_joints, "breakable_joints", "joints give way under load or are released",
       Phase::solve, breakable_joints, drop_breaks},
      {EffectId::gyroscopic_torque, "gyroscopic_torque", "spinning bodies precess", Phase::integrate,
       gyroscopic_torque, keep},
      {EffectId::gravity, "gravity", "bodies fall", Phase::integrate, gravity, drop_gravity},
      {EffectId::damping, "damping", "velocities die away", Phase::integrate, damping, drop_damping},
      {EffectId::sleeping, "sleeping", "islands at rest are not stepped until something touches them",
       Phase::islands, sleeping, keep},
  };
  return effects;
}

bool has_gyroscopic_torque(const model::Body& body) {
  return body.inertia != core::Mat3(body.inertia(0, 0) * core::Mat3::Identity());
}

}  // namespace pbmpi::effects
