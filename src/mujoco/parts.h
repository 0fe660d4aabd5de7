/// The length of MuJoCo's steps, several of which make up one step.
#pragma once

#include <algorithm>
#include <cmath>

#include "effects/effects.h"
#include "model/state.h"
#include "mujoco/compiled.h"

namespace pbmpi::mujoco {

/// MuJoCo's own default is 2 ms. In joint coordinates the inertial forces of rotation are taken from the
/// start of a step: with 10 ms, and with 5, ragdolls that a car hits at 25 m/s spin up until nothing is
/// finite.
inline constexpr double longest_part_s = 0.0025;

/// The same happens to a hand that turns by 0.3 to 0.5 rad within such a part, in some worlds of 100CrSk:
/// parts are halved until nothing turns farther than this [rad].
inline constexpr double farthest_turn = 0.25;

/// Most parts into which one of the longest parts is split.
inline constexpr int most_halves = 16;

/// Speed of a body's rotation [rad/s], except rotation that moves none of its mass: about an axle through its
/// centre of mass, as of a wheel, or of a free ball.
inline double turning_speed(const model::Model& model, const Link& link, const model::State& state,
                            int body) {
  const model::Vec3& velocity = state.angular_velocity[body];
  if (link.is_free() && !effects::has_gyroscopic_torque(model.bodies[body])) return 0 * velocity.norm();
  constexpr double at_centre_m = 1e-9;
  const bool on_axle = link.has_anchor && link.anchor_child.norm() < at_centre_m && !link.axes.empty() &&
                       link.axes.back().freedom == Freedom::hinge;
  if (!on_axle) return velocity.norm();
  const model::Vec3 axle = state.orientation[body].to_eigen() * link.axes.back().direction;
  return (velocity - axle * axle.dot(velocity)).norm();
}

/// False for non-finite values as well.
inline bool turns_little(const model::Model& model, const std::vector<Link>& links, const model::State& state,
                         double part_s) {
  for (int body = 0; body < model.num_bodies(); ++body) {
    if (!(turning_speed(model, links[body], state, body) * part_s <= farthest_turn)) return false;
  }
  return true;
}

/// A value slightly below a whole number of parts is rounding.
inline int fewest_parts(double dt_s) {
  return std::max(1, static_cast<int>(std::ceil(dt_s / longest_part_s - 1e-6)));
}

/// Sets the step length of the springs of all rows, the suspensions and the integrator, as mjcf_text() does.
inline void set_part(Compiled& compiled, const model::Model& model, double part_s) {
  mjModel& to = compiled.engine.model();
  if (to.opt.timestep == part_s) return;
  to.opt.timestep = part_s;
  const auto set_springs = [&](mjtNum* solref, int count) {
    for (int i = 0; i < count; ++i) solref[mjNREF * i] = 2 * part_s;
  };
  set_springs(to.jnt_solref, to.njnt);
  set_springs(to.dof_solref, to.nv);
  set_springs(to.geom_solref, to.ngeom);
  set_springs(to.eq_solref, to.neq);
  for (std::size_t body = 0; body < compiled.links.size(); ++body) {
    const Link& link = compiled.links[body];
    for (std::size_t k = 0; k < link.axes.size(); ++k) {
      if (!link.axes[k].is_suspension) continue;
      const model::Spring& spring = model.joints[link.hold.joint].suspension;
      const int axis = compiled.at.first_axis(static_cast<int>(body)) + static_cast<int>(k);
      to.dof_damping[to.jnt_dofadr[axis]] = spring.damping + part_s * spring.stiffness;
    }
  }
}

}  // namespace pbmpi::mujoco
