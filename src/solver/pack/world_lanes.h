/// The worlds of a pack in their lanes, and all data that goes in and out. (Longer than other files: its many
/// small functions all belong to the one interface between models and lanes.)
#pragma once

#include <algorithm>
#include <span>
#include <vector>

#include "geometry/geometry.h"
#include "solver/joints/broken_joints.h"
#include "solver/joints/joint_batches.h"
#include "solver/joints/joint_load.h"
#include "solver/layout/active_bodies.h"
#include "solver/layout/cells.h"
#include "solver/layout/held_lanes.h"
#include "solver/layout/joints_of_bodies.h"
#include "solver/layout/lane_places.h"
#include "solver/layout/passes.h"
#include "solver/pack/gyroscopic_slots.h"
#include "solver/pack/idle_lanes.h"
#include "solver/pack/set_lanes.h"
#include "stepping/stepper.h"

namespace pbmpi::solver {

template <class T>
class WorldLanes {
 public:
  using V = typename T::V;
  using Scalar = typename T::Scalar;
  using Batch = typename JointBatches<T>::Batch;

  WorldLanes(std::span<const PackedWorld> worlds, const Passes& passes);

  void load(int world, const model::State& state) {
    for (int body = 0; body < model(world).num_bodies(); ++body) load_body(world, body, state);
  }
  /// Stores joints' forces only where the state has room for them.
  void store(int world, model::State& state) const {
    for (int body = 0; body < model(world).num_bodies(); ++body) store_body(world, body, state);
  }
  void load_body(int world, int body, const model::State& state);
  void store_body(int world, int body, model::State& state) const;
  /// See Pack. Takes effect on batches at the next update_active().
  void set_active(int world, std::span<const int> moving) { active_.set(world, moving); }
  void set_awake(int world, std::span<const int> awake_bodies) { awake_.set(world, awake_bodies); }
  const ActiveBodies& awake() const { return awake_; }
  bool moves(int world, int body) const { return active_.contains(world, body); }
  void update_active();
  /// With Passes::holds_bodies(): around a step, for inactive bodies in active batches.
  void save_held() { held_.save(bodies); }
  void restore_held() { held_.restore(bodies); }
  /// 1 in the held lanes of a slot, else 0; null if none is held.
  const V* held_lanes(int slot) const { return holds_bodies_ ? held_.lanes(slot) : nullptr; }
  template <class Visit>
  void for_each_active_slot(Visit visit) const {
    for (const Batch& batch : active_batches_) {
      for (int slot = batch.first_slot; slot < batch.end_slot; ++slot) visit(slot);
    }
  }
  /// As of the last update_active(), in the order of their slots.
  std::span<const Batch> active_batches() const { return active_batches_; }
  void set_motor(int world, int joint, int axis, const model::AxisMotor& motor) {
    set_control(world, joint, axis, motor);
  }
  void set_limit(int world, int joint, int axis, const model::AxisLimit& limit) {
    set_control(world, joint, axis, limit);
  }
  void launch(int world, const model::Event& event);
  void set_load(int world, int body, const stepping::BodyLoad& load);
  void forget(int world, int body);
  /// True if more joints are broken than before.
  bool set_broken(int world, std::span<const std::int32_t> broken_in);
  /// What a joint exerted in the last substep, which took h [s].
  effects::Reaction reaction(int world, int joint, double h) const;
  model::Vec3 centre(int world, int body) const {
    const LanePlace at = places.body(world, body);
    return position(bodies.bodies[at.slot], at.lane);
  }
  void poses(int world, std::span<model::BodyPose> poses) const {
    for (std::size_t body = 0; body < poses.size(); ++body) poses[body] = pose(world, static_cast<int>(body));
  }
  model::BodyPose pose(int world, int body) const;
  int joint_rows(int world, int joint) const;
  /// Calls visit(rows, lane) for each joint of a world, as last solved.
  template <class Visit>
  void visit_joint_rows(int world, Visit visit) const {
    for_each_acting_joint(world, [&](const JointPlace& at) {
      joints.visit_rows(at.shape, at.joint, [&](const auto& rows) { visit(rows, at.lane); });
    });
  }
  /// Likewise, and may change the rows.
  template <class Visit>
  void change_joint_rows(int world, Visit visit) {
    for_each_acting_joint(world, [&](const JointPlace& at) {
      joints.change_rows(static_cast<std::size_t>(at.shape), static_cast<std::size_t>(at.joint),
                         [&](auto& rows) { visit(rows, at.lane); });
    });
  }
  int num_worlds() const { return static_cast<int>(models_.size()); }
  const model::Model& model(int world) const { return *models_[static_cast<std::size_t>(world)]; }

  LanePlaces places;  ///< where each body and joint lies
  BodyLanes<T> bodies;
  JointBatches<T> joints;
  std::vector<Vec3L<V>> gravity;              ///< [slots] with what loads add; worlds may differ
  std::vector<Vec3L<V>> torque;               ///< [slots] of loads [N m]; empty without any load
  std::vector<GyroscopicSlot<V>> gyroscopic;  ///< in the order of slots; none without the pass

 private:
  using Set = SetLanes<T>;

  template <class Visit>
  void for_each_acting_joint(int world, Visit visit) const {
    for (int joint = 0; joint < model(world).num_joints(); ++joint) {
      if (!active_.contains(world, model(world).joints[joint].body_a)) continue;
      if (!broken_.contains(world, joint)) visit(places.joint(world, joint));
    }
  }
  /// [m]
  static model::Vec3 position(const BodyLane<V>& body, int lane) {
    const auto number = [lane](const V& high, const V& low) {
      return static_cast<double>(T::get(high, lane)) + static_cast<double>(T::get(low, lane));
    };
    return {number(body.position.x, body.position_low.x), number(body.position.y, body.position_low.y),
            number(body.position.z, body.position_low.z)};
  }
  void set_masses(int world, int body);
  void set_fall(int world, int body, const model::Vec3& force);
  void set_joint(int world, const Articulation& articulation, std::size_t index);
  template <class Setting>
  void set_control(int world, int joint, int axis, const Setting& setting);
  void set_pose(LanePlace at, const model::Pose& pose);
  void set_twist(LanePlace at, const model::Vec3& linear, const model::Vec3& angular);
  void allow_idle_controls(const Passes& passes);
  JointLane<V>& joint_at(int world, int joint) {
    const JointPlace& at = places.joint(world, joint);
    return joints.joints(at.shape)[at.joint];
  }
  const JointLane<V>& joint_at(int world, int joint) const {
    const JointPlace& at = places.joint(world, joint);
    return joints.joints(at.shape)[at.joint];
  }

  /// The joints whose first body this is.
  std::span<const int> joints_of(int world, int body) const {
    const JointsOfBodies& all = joints_of_bodies_[static_cast<std::size_t>(world)];
    const auto first = static_cast<std::size_t>(all.first[static_cast<std::size_t>(body)]);
    return std::span(all.joints)
        .subspan(first, static_cast<std::size_t>(all.first[static_cast<std::size_t>(body) + 1]) - first);
  }

  std::vector<const model::Model*> models_;
  std::vector<JointsOfBodies> joints_of_bodies_;  ///< [num_worlds]
  bool holds_bodies_;
  ActiveBodies active_, awake_;
  BrokenJoints broken_;
  long active_revision_ = 0;  ///< for which slot_active_ and the batches hold
  std::vector<Batch> all_batches_, active_batches_;
  std::vector<char> slot_active_;  ///< [slots]; empty: all are
  HeldLanes<T> held_;
};

template <class T>
WorldLanes<T>::WorldLanes(std::span<const PackedWorld> worlds, const Passes& passes)
    : places(worlds, T::num_lanes, bodies_in_cache(sizeof(Scalar))),
      bodies(places.num_slots()),
      gravity(static_cast<std::size_t>(places.num_slots()),
              {T::broadcast(0), T::broadcast(0), T::broadcast(0)}),
      holds_bodies_(passes.holds_bodies()) {
  for (const LanePlaces::ShapePlace& at : places.shapes())
    joints.add_shape(at.shape, at.first_slot, at.num_batches, bodies.static_slot);
  all_batches_ = active_batches_ = joints.all();
  for (int w = 0; w < static_cast<int>(worlds.size()); ++w) {
    const PackedWorld& world = worlds[static_cast<std::size_t>(w)];
    models_.push_back(world.model);
    active_.add_world(world.model->num_bodies());
    awake_.add_world(world.model->num_bodies());
    broken_.add_world();
    for (int body = 0; body < world.model->num_bodies(); ++body) set_masses(w, body);
    for (const Articulation& articulation : world.articulations) {
      for (std::size_t j = 0; j < articulation.joints.size(); ++j) set_joint(w, articulation, j);
    }
    joints_of_bodies_.emplace_back(*world.model);
    load(w, model::initial_state(*world.model));
  }
  allow_idle_controls(passes);
  if (passes.gyroscopic_torque)
    gyroscopic = find_gyroscopic_slots<T>(places, models_, passes.idle_gyroscopic_torque);
  fill_idle_lanes(places, bodies, joints);
  for (BodyLane<V>& body : bodies.bodies) refresh(body);
}

/// Sets the constant terms of a joint, and its initial limits and motors.
template <class T>
void WorldLanes<T>::set_joint(int world, const Articulation& articulation, std::size_t index) {
  const int joint = articulation.joints[index];
  Set::set(joint_at(world, joint).terms, places.joint(world, joint).lane, articulation.terms[index]);
  for (int axis = 0; axis < 2; ++axis) {
    const auto a = static_cast<std::size_t>(axis);
    set_limit(world, joint, axis, model(world).joints[joint].limits[a]);
    set_motor(world, joint, axis, model(world).joints[joint].motors[a]);
    Set::set_armature(joint_at(world, joint).controls[axis], places.joint(world, joint).lane,
                      model(world).joints[joint].armature[a]);
  }
}

template <class T>
void WorldLanes<T>::set_masses(int world, int body) {
  const LanePlace at = places.body(world, body);
  const model::Body& source = model(world).bodies[body];
  BodyLane<V>& lane = bodies.bodies[at.slot];
  Set::set(lane.inv_mass, at.lane, 1 / source.mass_kg);
  Set::set(lane.inertia_body, at.lane, source.inertia);
  Set::set(lane.inv_inertia_body, at.lane, model::Mat3(source.inertia.inverse()));
  set_fall(world, body, model::Vec3::Zero());
}

/// Adding -0 changes no number, adding +0 changes -0.
template <class T>
void WorldLanes<T>::set_fall(int world, int body, const model::Vec3& force) {
  const LanePlace at = places.body(world, body);
  model::Vec3 fall = model(world).gravity;
  if (!force.isZero(0)) fall += force / model(world).bodies[body].mass_kg;
  Set::set(gravity[at.slot], at.lane, fall.isZero(0) ? model::Vec3(model::Vec3::Constant(-0.0)) : fall);
}

template <class T>
void WorldLanes<T>::set_load(int world, int body, const stepping::BodyLoad& load) {
  set_fall(world, body, load.force);
  const V zero = T::broadcast(0);
  if (torque.empty()) torque.assign(gravity.size(), {zero, zero, zero});
  const LanePlace at = places.body(world, body);
  Set::set(torque[at.slot], at.lane, load.torque);
}

/// Makes rows for limits and motors that are demanded though nothing calls for them: their limits are out of
/// reach and their motors have no force, so that they exert nothing.
template <class T>
void WorldLanes<T>::allow_idle_controls(const Passes& passes) {
  for (int world = 0; world < num_worlds(); ++world) {
    for (int joint = 0; joint < model(world).num_joints(); ++joint) {
      const model::JointTraits& traits = model::traits_of(model(world).joints[joint].kind);
      AxisControl<V>* controls = joint_at(world, joint).controls;
      for (std::size_t axis = 0; axis < traits.axes.size(); ++axis) {
        controls[axis].has_limit |= passes.idle_limits && traits.axes[axis].has_limit;
        controls[axis].has_motor |= passes.idle_motors && traits.axes[axis].has_motor;
      }
    }
  }
}

template <class T>
void WorldLanes<T>::load_body(int world, int body, const model::State& state) {
  const LanePlace at = places.body(world, body);
  set_pose(at, {state.position[body], state.orientation[body]});
  set_twist(at, state.velocity[body], state.angular_velocity[body]);
  for (const int joint : joints_of(world, body)) {
    const bool remembers = !state.memory.joints.empty();
    const model::JointForce force =
        remembers ? state.memory.joints[static_cast<std::size_t>(joint)] : model::JointForce{};
    Set::set(joint_at(world, joint).memory, places.joint(world, joint).lane, force);
  }
}

template <class T>
void WorldLanes<T>::store_body(int world, int body, model::State& state) const {
  const auto vector_of = [](const Vec3L<V>& v, int lane) {
    return model::Vec3(T::get(v.x, lane), T::get(v.y, lane), T::get(v.z, lane));
  };
  const LanePlace at = places.body(world, body);
  const BodyLane<V>& lanes = bodies.bodies[at.slot];
  state.position[body] = position(lanes, at.lane);
  state.orientation[body] = {T::get(lanes.qw, at.lane), T::get(lanes.qx, at.lane), T::get(lanes.qy, at.lane),
                             T::get(lanes.qz, at.lane)};
  state.velocity[body] = vector_of(bodies.twists[at.slot].linear, at.lane);
  state.angular_velocity[body] = vector_of(bodies.twists[at.slot].angular, at.lane);
  if (state.memory.joints.empty()) return;
  for (const int joint : joints_of(world, body)) {
    const JointForceLane<V>& memory = joint_at(world, joint).memory;
    const int lane = places.joint(world, joint).lane;
    model::JointForce& force = state.memory.joints[static_cast<std::size_t>(joint)];
    force.force = vector_of(memory.force, lane);
    force.torque = vector_of(memory.torque, lane);
    for (std::size_t axis = 0; axis < 2; ++axis) {
      force.control[axis] = T::get(memory.control[axis], lane);
      force.rotor[axis] = T::get(memory.rotor[axis], lane);
      force.angle[axis] = T::get(memory.angle[axis], lane);
    }
  }
}

template <class T>
void WorldLanes<T>::update_active() {
  if (active_revision_ == active_.revision()) return;
  active_revision_ = active_.revision();
  slot_active_.assign(gravity.size(), 0);
  for (int world = 0; world < num_worlds(); ++world) {
    for (const int body : active_.of(world)) slot_active_[places.body(world, body).slot] = 1;
  }
  active_batches_.clear();
  for (const Batch& batch : all_batches_) {
    const auto first = slot_active_.begin() + batch.first_slot, end = slot_active_.begin() + batch.end_slot;
    if (std::find(first, end, 1) == end) continue;
    std::fill(first, end, 1);
    active_batches_.push_back(batch);
  }
  if (!holds_bodies_) return;
  std::vector<LanePlace> held;
  for (int world = 0; world < num_worlds(); ++world) {
    for (int body = 0; body < model(world).num_bodies(); ++body) {
      const LanePlace at = places.body(world, body);
      if (slot_active_[at.slot] && !active_.contains(world, body)) held.push_back(at);
    }
  }
  held_.hold(bodies.static_slot, held);
}

template <class T>
template <class Setting>
void WorldLanes<T>::set_control(int world, int joint, int axis, const Setting& setting) {
  if (broken_.contains(world, joint)) return;
  Set::set(joint_at(world, joint).controls[axis], places.joint(world, joint).lane, setting);
}

template <class T>
void WorldLanes<T>::launch(int world, const model::Event& event) {
  const LanePlace at = places.body(world, event.body);
  set_twist(at, event.velocity, event.angular_velocity);
  if (event.pose) set_pose(at, *event.pose);
}

template <class T>
void WorldLanes<T>::forget(int world, int body) {
  for (int joint = 0; joint < model(world).num_joints(); ++joint) {
    const model::Joint& held = model(world).joints[static_cast<std::size_t>(joint)];
    if (held.body_a != body && held.body_b != body) continue;
    Set::set(joint_at(world, joint).memory, places.joint(world, joint).lane, model::JointForce{});
  }
}

template <class T>
bool WorldLanes<T>::set_broken(int world, std::span<const std::int32_t> broken_in) {
  const std::span<const int> fresh = broken_.find_fresh(world, broken_in);
  if (fresh.empty()) return false;
  for (const int joint : fresh) {
    for (const int axis : {0, 1}) {
      set_motor(world, joint, axis, {});
      set_limit(world, joint, axis, {});
    }
    const JointPlace& at = places.joint(world, joint);
    joints.set_broken(at.shape, at.joint, at.lane);
  }
  broken_.set(world, broken_in);
  return true;
}

template <class T>
effects::Reaction WorldLanes<T>::reaction(int world, int joint, double h) const {
  const JointPlace& at = places.joint(world, joint);
  const model::Joint& held = model(world).joints[joint];
  JointLoad load;
  joints.visit_rows(at.shape, at.joint, [&](const auto& rows) { load = load_of(rows, at.lane); });
  return reaction_of(load, model(world), held, pose(world, held.body_a), h);
}

template <class T>
void WorldLanes<T>::set_pose(LanePlace at, const model::Pose& pose) {
  Set::set(bodies.bodies[at.slot], at.lane, pose);
  refresh(bodies.bodies[at.slot]);
}

template <class T>
void WorldLanes<T>::set_twist(LanePlace at, const model::Vec3& linear, const model::Vec3& angular) {
  Set::set(bodies.twists[at.slot].linear, at.lane, linear);
  Set::set(bodies.twists[at.slot].angular, at.lane, angular);
}

/// The rotation is computed in double from the quaternion: with a float rotation ODE's colliders mistake
/// rounding noise for a contact normal.
template <class T>
model::BodyPose WorldLanes<T>::pose(int world, int body) const {
  const LanePlace at = places.body(world, body);
  const BodyLane<V>& lanes = bodies.bodies[at.slot];
  model::BodyPose pose;
  Eigen::Map<model::Vec3>(pose.position) = position(lanes, at.lane);
  geometry::to_rotation(T::get(lanes.qw, at.lane), T::get(lanes.qx, at.lane), T::get(lanes.qy, at.lane),
                        T::get(lanes.qz, at.lane), pose.rotation);
  return pose;
}

template <class T>
int WorldLanes<T>::joint_rows(int world, int joint) const {
  const JointPlace& at = places.joint(world, joint);
  return joints.num_rows(at.shape, at.joint, at.lane);
}

}  // namespace pbmpi::solver
