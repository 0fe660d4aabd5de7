#include "stability/energy_gain.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include <Eigen/Eigenvalues>

#include "model/joint_traits.h"
#include "model/mechanics.h"

namespace pbmpi::stability {
namespace {

using model::Event;
using model::EventKind;
using model::Joint;
using model::Model;
using model::State;
using model::Vec3;

using EventsOfJoint = std::array<std::vector<Event>, 2>;

/// [num_joints] the motor and steer events of each axis; a steer event turns a joint's first axis.
std::vector<EventsOfJoint> drive_events(const Model& model) {
  std::vector<EventsOfJoint> events(model.joints.size());
  for (const Event& event : model.events) {
    if (event.kind == EventKind::motor) events[event.joint][event.axis].push_back(event);
    if (event.kind == EventKind::steer) events[event.joint][0].push_back(event);
  }
  return events;
}

bool steers(const Event& event) { return event.kind == EventKind::steer; }

double largest_inertia(const model::Body& body) {
  return Eigen::SelfAdjointEigenSolver<model::Mat3>(body.inertia, Eigen::EigenvaluesOnly).eigenvalues().z();
}

double lighter_inertia(const Model& model, const Joint& joint) {
  const double inertia = largest_inertia(model.bodies[joint.body_a]);
  if (joint.body_b == model::no_body) return inertia;
  return std::min(inertia, largest_inertia(model.bodies[joint.body_b]));
}

/// A steered axis is turned with whatever torque that takes; in each step it gains at most the kinetic energy
/// of its lighter body at the axis' speed.
double steering_work(double inertia, double speed, int num_steps) {
  return 0.5 * inertia * speed * speed * num_steps;
}

using model::State;
using model::Vec3;

/// Displacement of a suspension from its rest position [m].
double travel_of(const Suspension& suspension, const State& state) {
  const model::Pose a = state.pose(suspension.body_a), b = state.pose(suspension.body_b);
  const Vec3 axis = a.direction_to_outer(suspension.axis);
  return axis.dot(a.point_to_outer(suspension.anchor_a) - b.point_to_outer(suspension.anchor_b));
}

using model::Event;
using model::EventKind;
using model::Model;
using model::State;

/// Energy of launched bodies after their launches, minus the least energy that they can have had before.
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
    // The body may have lost its speed in the steps before a later launch.
    const double least = event.step == first_step ? had : std::min(had, had_at_rest);
    work += body_energy(model, launched, body) - least;
  }
  return work;
}

}  // namespace

/// The drive of an axis at any time between two states.
struct DriveWork::Drive {
  double max_force = 0;  ///< largest force
  double target = 0;     ///< largest target speed [rad/s or m/s]
  bool steered = false;
  double turned = 0;  ///< largest change of a steered angle from one event to the next [rad]
  double angle = 0;   ///< that of the last steer event [rad]

  void include(const model::AxisMotor& motor) {
    max_force = std::max(max_force, motor.max_force);
    target = std::max(target, motor.active() ? std::abs(motor.velocity) : 0.0);
  }
};

DriveWork::DriveWork(const Model& model, double dt_s) : dt_s_(dt_s) {
  std::vector<EventsOfJoint> events = drive_events(model);
  for (std::size_t i = 0; i < model.joints.size(); ++i) {
    const Joint& joint = model.joints[i];
    for (const std::size_t axis : {0, 1}) {
      if (joint.motors[axis].max_force <= 0 && events[i][axis].empty()) continue;
      Axis& one = axes_.emplace_back();
      one.joint = i;
      one.body_a = joint.body_a;
      one.body_b = joint.body_b;
      one.holder = axis == 0 ? joint.body_a : joint.body_b;
      one.direction = axis == 0 ? joint.axis1_a : joint.axis2_b;
      one.slides = traits_of(joint.kind).slides;
      one.motor = joint.motors[axis];
      one.events = std::move(events[i][axis]);
      if (std::ranges::any_of(one.events, steers)) one.inertia = lighter_inertia(model, joint);
    }
  }
}

DriveWork::Drive DriveWork::drive_of(const Axis& axis, std::int64_t first_step, int num_steps) {
  Drive drive;
  drive.include(axis.motor);
  for (const Event& event : axis.events) {
    if (event.step >= first_step + num_steps) break;
    if (event.kind == EventKind::motor) {
      if (event.step <= first_step) drive.max_force = drive.target = 0;  // replaces the motor before
      drive.include(event.motor);
    } else {
      drive.steered = true;
      if (event.step >= first_step)
        drive.turned = std::max(drive.turned, std::abs(event.angle - drive.angle));
      drive.angle = event.angle;
    }
  }
  return drive;
}

/// Speed of the axis [rad/s, or m/s where the joint slides].
double DriveWork::speed_of(const Axis& axis, const State& state) {
  const Vec3 direction = axis.holder == model::no_body
                             ? axis.direction
                             : Vec3(state.orientation[axis.holder].to_eigen() * axis.direction);
  const std::vector<Vec3>& rates = axis.slides ? state.velocity : state.angular_velocity;
  Vec3 rate = rates[axis.body_a];
  if (axis.body_b != model::no_body) rate -= rates[axis.body_b];
  return std::abs(direction.dot(rate));
}

double DriveWork::most(const State& before, const State& after, std::int64_t first_step,
                       int num_steps) const {
  double work = 0;
  for (const Axis& axis : axes_) {
    if (before.is_broken(axis.joint)) continue;
    const Drive drive = drive_of(axis, first_step, num_steps);
    if (drive.max_force <= 0 && !drive.steered) continue;
    const double speed = std::max(speed_of(axis, before), speed_of(axis, after));
    work += drive.max_force * std::max(speed, drive.target) * num_steps * dt_s_;
    if (drive.steered) work += steering_work(axis.inertia, std::max(speed, drive.turned / dt_s_), num_steps);
  }
  return work;
}

std::vector<Suspension> suspensions_of(const model::Model& model) {
  std::vector<Suspension> all;
  for (std::size_t i = 0; i < model.joints.size(); ++i) {
    const model::Joint& joint = model.joints[i];
    if (!traits_of(joint.kind).has_suspension() || joint.suspension.stiffness <= 0) continue;
    all.push_back({i, joint.body_a, joint.body_b, joint.anchor_a, joint.anchor_b, joint.axis1_a,
                   joint.suspension.stiffness});
  }
  return all;
}

double energy_of(const Suspension& suspension, const State& state) {
  if (state.is_broken(suspension.joint)) return 0;
  const double travel = travel_of(suspension, state);
  return 0.5 * suspension.stiffness * travel * travel;
}

double spring_energy(const Model& model, const State& state) {
  double energy = 0;
  for (const Suspension& spring : suspensions_of(model)) energy += energy_of(spring, state);
  return energy;
}

double allowed_work(const Model& model, const State& before, const State& after, std::int64_t first_step,
                    int num_steps, double dt_s) {
  return DriveWork(model, dt_s).most(before, after, first_step, num_steps) +
         launch_work(model, before, first_step, num_steps) + spring_energy(model, before) -
         spring_energy(model, after);
}

EnergyGain::EnergyGain(const Model& model, double dt_s)
    : model_(&model), drives_(model, dt_s), springs_(suspensions_of(model)) {}

void EnergyGain::add(const At& before, const At& after, std::int64_t first_step, int num_steps,
                     model::GuardMemory& memory) const {
  double change = after.energy_j - before.energy_j;
  for (const Suspension& spring : springs_)
    change += energy_of(spring, after.state) - energy_of(spring, before.state);
  change -= launch_work(*model_, before.state, first_step, num_steps);
  if (change <= 0 && memory.energy_gain_j == 0) return;
  change -= drives_.most(before.state, after.state, first_step, num_steps);
  memory.energy_gain_j = std::max(0.0, memory.energy_gain_j + change);
}

}  // namespace pbmpi::stability
