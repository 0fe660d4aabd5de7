#include "stability/energy_gain.h"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "model/joint_traits.h"
#include "model/mechanics.h"
#include "stability/events_in.h"

namespace pbmpi::stability {
namespace {

using model::Event;
using model::EventKind;
using model::Joint;
using model::Model;
using model::State;
using model::Vec3;

Vec3 point_in_world(const State& state, int body, const Vec3& local) {
  if (body == model::no_body) return local;
  return state.position[body] + state.orientation[body].to_eigen() * local;
}

bool has_spring(const Joint& joint) {
  return traits_of(joint.kind).has_suspension() && joint.suspension.stiffness > 0;
}

/// How far a suspension is from its rest [m].
double spring_travel(const State& state, const Joint& joint) {
  const Vec3 axis = state.orientation[joint.body_a].to_eigen() * joint.axis1_a;
  return axis.dot(point_in_world(state, joint.body_a, joint.anchor_a) -
                  point_in_world(state, joint.body_b, joint.anchor_b));
}

double spring_energy_of(const Model& model, const State& state, std::size_t joint) {
  if (state.is_broken(joint)) return 0;
  const double travel = spring_travel(state, model.joints[joint]);
  return 0.5 * model.joints[joint].suspension.stiffness * travel * travel;
}

/// What drives an axis at any time between two states.
struct Drive {
  double max_force = 0;  ///< largest
  double target = 0;     ///< largest speed aimed at [rad/s or m/s]
  bool steered = false;
  double turned = 0;  ///< largest change of a steered angle from one event to the next [rad]
  double angle = 0;   ///< of the last steer event [rad]

  void include(const model::AxisMotor& motor) {
    max_force = std::max(max_force, motor.max_force);
    target = std::max(target, motor.active() ? std::abs(motor.velocity) : 0.0);
  }
};
using Drives = std::vector<std::array<Drive, 2>>;

/// [num_joints] What drives the axes from step `first` on, for `count` steps.
Drives drives_of(const Model& model, std::int64_t first, std::int64_t count) {
  Drives drives(model.joints.size());
  for (std::size_t joint = 0; joint < drives.size(); ++joint) {
    for (const std::size_t axis : {0, 1}) drives[joint][axis].include(model.joints[joint].motors[axis]);
  }
  for (const Event& event : model.events) {
    if (event.step >= first + count) break;
    if (event.kind == EventKind::motor) {
      Drive& drive = drives[event.joint][event.axis];
      if (event.step <= first) drive.max_force = drive.target = 0;  // it replaces the motor before
      drive.include(event.motor);
    } else if (event.kind == EventKind::steer) {
      Drive& drive = drives[event.joint][0];
      drive.steered = true;
      if (event.step >= first) drive.turned = std::max(drive.turned, std::abs(event.angle - drive.angle));
      drive.angle = event.angle;
    }
  }
  return drives;
}

/// Speed of an axis [rad/s, or m/s where the joint slides].
double axis_speed(const State& state, const Joint& joint, int axis) {
  const int holder = axis == 0 ? joint.body_a : joint.body_b;
  const Vec3& local = axis == 0 ? joint.axis1_a : joint.axis2_b;
  const Vec3 direction =
      holder == model::no_body ? local : Vec3(state.orientation[holder].to_eigen() * local);
  const std::vector<Vec3>& rates = traits_of(joint.kind).slides ? state.velocity : state.angular_velocity;
  Vec3 rate = rates[joint.body_a];
  if (joint.body_b != model::no_body) rate -= rates[joint.body_b];
  return std::abs(direction.dot(rate));
}

double largest_inertia(const model::Body& body) {
  return Eigen::SelfAdjointEigenSolver<model::Mat3>(body.inertia, Eigen::EigenvaluesOnly).eigenvalues().z();
}

/// A steered axis is turned by whatever torque it takes; what it gains in each step is at most the kinetic
/// energy of its lighter body at the axis' speed.
double steering_work(const Model& model, const Joint& joint, double speed, int num_steps) {
  double inertia = largest_inertia(model.bodies[joint.body_a]);
  if (joint.body_b != model::no_body)
    inertia = std::min(inertia, largest_inertia(model.bodies[joint.body_b]));
  return 0.5 * inertia * speed * speed * num_steps;
}

double drive_work(const Model& model, const State& before, const State& after, std::int64_t first_step,
                  int num_steps, double dt_s) {
  double work = 0;
  const Drives drives = drives_of(model, first_step, num_steps);
  for (std::size_t i = 0; i < drives.size(); ++i) {
    if (before.is_broken(i)) continue;
    const Joint& joint = model.joints[i];
    for (const int axis : {0, 1}) {
      const Drive& drive = drives[i][static_cast<std::size_t>(axis)];
      if (drive.max_force <= 0 && !drive.steered) continue;
      const double speed = std::max(axis_speed(before, joint, axis), axis_speed(after, joint, axis));
      work += drive.max_force * std::max(speed, drive.target) * num_steps * dt_s;
      if (drive.steered) work += steering_work(model, joint, std::max(speed, drive.turned / dt_s), num_steps);
    }
  }
  return work;
}

/// Energy of launched bodies after their launches, less the least that they can have had before.
double launch_work(const Model& model, const State& before, std::int64_t first_step, int num_steps) {
  double work = 0;
  State launched;
  for (const Event& event : events_in(model, first_step, num_steps)) {
    if (event.kind != EventKind::launch) continue;
    if (launched.position.empty()) launched = before;
    const int body = event.body;
    const double had = body_energy(model, launched, body);
    launched.velocity[body].setZero();
    launched.angular_velocity[body].setZero();
    const double had_at_rest = body_energy(model, launched, body);
    if (event.pose) {
      launched.position[body] = event.pose->position;
      launched.orientation[body] = event.pose->orientation;
    }
    launched.velocity[body] = event.velocity;
    launched.angular_velocity[body] = event.angular_velocity;
    // In the steps before a later launch the body may have lost its speed.
    const double least = event.step == first_step ? had : std::min(had, had_at_rest);
    work += body_energy(model, launched, body) - least;
  }
  return work;
}

}  // namespace

double spring_energy(const Model& model, const State& state) {
  double energy = 0;
  for (std::size_t i = 0; i < model.joints.size(); ++i) {
    if (has_spring(model.joints[i])) energy += spring_energy_of(model, state, i);
  }
  return energy;
}

double allowed_work(const Model& model, const State& before, const State& after, std::int64_t first_step,
                    int num_steps, double dt_s) {
  return drive_work(model, before, after, first_step, num_steps, dt_s) +
         launch_work(model, before, first_step, num_steps) + spring_energy(model, before) -
         spring_energy(model, after);
}

EnergyGain::EnergyGain(const Model& model, double dt_s) : model_(&model), dt_s_(dt_s) {
  for (std::size_t i = 0; i < model.joints.size(); ++i) {
    if (has_spring(model.joints[i])) springs_.push_back(i);
  }
}

void EnergyGain::add(const At& before, const At& after, std::int64_t first_step, int num_steps,
                     model::GuardMemory& memory) const {
  double change = after.energy_j - before.energy_j;
  for (const std::size_t joint : springs_)
    change += spring_energy_of(*model_, after.state, joint) - spring_energy_of(*model_, before.state, joint);
  change -= launch_work(*model_, before.state, first_step, num_steps);
  if (change <= 0 && memory.energy_gain_j == 0) return;
  change -= drive_work(*model_, before.state, after.state, first_step, num_steps, dt_s_);
  memory.energy_gain_j = std::max(0.0, memory.energy_gain_j + change);
}

}  // namespace pbmpi::stability
