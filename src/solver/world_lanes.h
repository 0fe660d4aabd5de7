/// The worlds of a pack in their lanes: which body and joint lies where, and all that goes in and out.
#pragma once

#include <algorithm>
#include <map>
#include <span>
#include <utility>
#include <vector>

#include "model/geometry.h"
#include "solver/active_bodies.h"
#include "solver/broken_joints.h"
#include "solver/held_lanes.h"
#include "solver/joint_batches.h"
#include "solver/load_meter.h"
#include "solver/manifold_order.h"
#include "solver/pack.h"
#include "solver/passes.h"

namespace pbmpi::solver {

template <class T>
class WorldLanes {
 public:
  using V = typename T::V;
  using Scalar = typename T::Scalar;

  /// A slot of bodies with gyroscopic torque, and 1 in the lanes that have it, else 0.
  struct alignas(sizeof(V)) GyroscopicSlot {
    V has_torque;
    int slot = 0;
  };

  WorldLanes(std::span<const PackedWorld> worlds, const Passes& passes);

  void load(int world, const model::State& state) {
    for (std::size_t body = 0; body < worlds_[world].bodies.size(); ++body)
      load_body(world, static_cast<int>(body), state);
  }
  void store(int world, model::State& state) const {
    for (std::size_t body = 0; body < worlds_[world].bodies.size(); ++body)
      store_body(world, static_cast<int>(body), state);
  }
  void load_body(int world, int body, const model::State& state);
  void store_body(int world, int body, model::State& state) const {
    store_body(world, body, bodies.bodies.data(), state);
  }
  /// A world as it would be with these poses [slots] and the twists of now.
  void store_with(const PoseLane<V>* poses, int world, model::State& state) const {
    for (std::size_t body = 0; body < worlds_[world].bodies.size(); ++body)
      store_body(world, static_cast<int>(body), poses, state);
  }
  /// See Pack. Batches know of it after the next update_active().
  void set_active(int world, std::span<const int> moving) { active_.set(world, moving); }
  void set_awake(int world, std::span<const int> awake_bodies) { awake_.set(world, awake_bodies); }
  const ActiveBodies& awake() const { return awake_; }
  bool moves(int world, int body) const { return active_.contains(world, body); }
  void update_active();
  /// With Passes::holds_bodies(): round a step, for the bodies that are not active in batches that are.
  void save_held() { held_.save(bodies); }
  void restore_held() { held_.restore(bodies); }
  template <class Visit>
  void for_each_active_slot(Visit visit) const {
    joints.for_each_active_batch([&](const auto& batch) {
      for (int slot = batch.first_slot; slot < batch.end_slot; ++slot) visit(slot);
    });
  }
  void set_motor(int world, int joint, int axis, const model::AxisMotor& motor);
  void set_limit(int world, int joint, int axis, const model::AxisLimit& limit);
  void launch(int world, const model::Event& event);
  /// True if more joints are broken than before.
  bool set_broken(int world, std::span<const std::int32_t> broken_in);
  /// Of the last substep, of h seconds.
  model::Reaction reaction(int world, int joint, double h) const;
  void poses(int world, std::span<model::BodyPose> poses) const {
    for (std::size_t body = 0; body < poses.size(); ++body) poses[body] = pose(world, static_cast<int>(body));
  }
  model::BodyPose pose(int world, int body) const;
  int joint_rows(int world, int joint) const;
  /// visit(rows, lane) of each joint of a world, as last solved.
  template <class Visit>
  void visit_joint_rows(int world, Visit visit) const {
    const World& one = worlds_[world];
    for (std::size_t joint = 0; joint < one.joints.size(); ++joint) {
      if (!active_.contains(world, one.model->joints[joint].body_a)) continue;
      if (broken_.contains(world, static_cast<int>(joint))) continue;
      const JointPlace& at = one.joints[joint];
      joints.visit_rows(at.shape, at.joint, [&](const auto& rows) { visit(rows, at.lane); });
    }
  }
  /// The world whose body lies there; -1 for the static slot and idle lanes.
  int world_at(LanePlace place) const {
    return place.slot == bodies.static_slot ? -1 : world_at_.data()[place.slot * T::num_lanes + place.lane];
  }

  int num_worlds() const { return static_cast<int>(worlds_.size()); }
  const model::Model& model(int world) const { return *worlds_[static_cast<std::size_t>(world)].model; }
  /// Where a body lies; the environment (no_body) in lane 0 of the static slot.
  LanePlace body_place(int world, int body) const {
    return body == model::no_body ? LanePlace{bodies.static_slot, 0} : worlds_[world].bodies[body];
  }

  bool has_joints(int slot) const { return joint_count_.data()[slot] > 0; }

  BodyLanes<T> bodies{0};
  JointBatches<T> joints;
  std::vector<Vec3L<V>> gravity;           ///< [slots] worlds may differ
  std::vector<GyroscopicSlot> gyroscopic;  ///< in the order of slots; none without the pass

 private:
  struct JointPlace {
    int shape = 0, joint = 0, lane = 0;  ///< joint: of joints.joints(shape)
  };
  struct World {
    const model::Model* model = nullptr;
    std::vector<LanePlace> bodies;
    std::vector<JointPlace> joints;
  };
  /// Copies of one shape, with their worlds.
  using Copies = std::vector<std::pair<int, const Articulation*>>;

  /// `poses`: BodyLane or PoseLane, [slots].
  template <class Poses>
  void store_body(int world, int body, const Poses* poses, model::State& state) const;
  void place(std::span<const PackedWorld> worlds);
  void place_copies(const ArticulationShape& shape, const Copies& copies, int first_slot, int shape_index);
  void set_masses(const World& world, int body);
  void set_pose(const LanePlace& at, const model::Pose& pose);
  void set_terms(const World& world, int joint, const JointTerms& terms);
  void fill_idle_lanes();
  void find_gyroscopic(bool all_slots);
  void allow_idle_controls(const Passes& passes);
  JointLane<V>& joint_at(const World& world, int joint) {
    const JointPlace& at = world.joints[joint];
    return joints.joints(at.shape)[at.joint];
  }

  std::vector<World> worlds_;
  std::vector<int> world_at_;  ///< [slots x num_lanes]
  bool holds_bodies_;
  ActiveBodies active_, awake_;
  BrokenJoints broken_;
  long active_revision_ = 0;       ///< that slot_active_ and the batches are of
  std::vector<char> slot_active_;  ///< [slots]; empty: all are
  HeldLanes<T> held_;
  std::vector<int> joint_count_;  ///< [slots] of the articulation that a slot belongs to
};

template <class T>
WorldLanes<T>::WorldLanes(std::span<const PackedWorld> worlds, const Passes& passes)
    : holds_bodies_(passes.holds_bodies()) {
  place(worlds);
  for (const PackedWorld& world : worlds) {
    active_.add_world(world.model->num_bodies());
    awake_.add_world(world.model->num_bodies());
    broken_.add_world();
  }
  for (std::size_t w = 0; w < worlds.size(); ++w) {
    const World& world = worlds_[w];
    for (std::size_t body = 0; body < world.bodies.size(); ++body) set_masses(world, static_cast<int>(body));
    for (const Articulation& articulation : worlds[w].articulations) {
      for (std::size_t j = 0; j < articulation.joints.size(); ++j)
        set_terms(world, articulation.joints[j], articulation.terms[j]);
    }
    for (std::size_t j = 0; j < world.joints.size(); ++j) {
      const model::Joint& joint = world.model->joints[j];
      for (int axis = 0; axis < 2; ++axis) {
        set_limit(static_cast<int>(w), static_cast<int>(j), axis,
                  joint.limits[static_cast<std::size_t>(axis)]);
        set_motor(static_cast<int>(w), static_cast<int>(j), axis,
                  joint.motors[static_cast<std::size_t>(axis)]);
      }
    }
    load(static_cast<int>(w), model::initial_state(*world.model));
  }
  allow_idle_controls(passes);
  if (passes.gyroscopic_torque) find_gyroscopic(passes.idle_gyroscopic_torque);
  fill_idle_lanes();
  for (BodyLane<V>& body : bodies.bodies) refresh(body);
}

/// Gives each body a slot and a lane, shape by shape, world by world.
template <class T>
void WorldLanes<T>::place(std::span<const PackedWorld> worlds) {
  std::map<ArticulationShape, Copies> copies;
  for (std::size_t w = 0; w < worlds.size(); ++w) {
    worlds_.push_back({worlds[w].model, std::vector<LanePlace>(worlds[w].model->bodies.size()),
                       std::vector<JointPlace>(worlds[w].model->joints.size())});
    for (const Articulation& articulation : worlds[w].articulations)
      copies[articulation.shape].emplace_back(static_cast<int>(w), &articulation);
  }
  const auto num_batches = [](const Copies& members) {
    return (static_cast<int>(members.size()) + T::num_lanes - 1) / T::num_lanes;
  };
  int num_slots = 0;
  for (const auto& [shape, members] : copies) num_slots += num_batches(members) * shape.num_bodies;
  bodies = BodyLanes<T>(num_slots);
  gravity.assign(static_cast<std::size_t>(num_slots), {T::broadcast(0), T::broadcast(0), T::broadcast(0)});
  int first_slot = 0;
  world_at_.assign(static_cast<std::size_t>(num_slots * T::num_lanes), -1);
  joint_count_.assign(static_cast<std::size_t>(num_slots), 0);
  for (const auto& [shape, members] : copies) {
    std::fill_n(joint_count_.begin() + first_slot, num_batches(members) * shape.num_bodies,
                static_cast<int>(shape.joints.size()));
    const int index = joints.add_shape(shape, first_slot, num_batches(members), bodies.static_slot);
    place_copies(shape, members, first_slot, index);
    first_slot += num_batches(members) * shape.num_bodies;
  }
}

template <class T>
void WorldLanes<T>::place_copies(const ArticulationShape& shape, const Copies& copies, int first_slot,
                                 int shape_index) {
  for (std::size_t m = 0; m < copies.size(); ++m) {
    const auto [w, articulation] = copies[m];
    const int batch = static_cast<int>(m) / T::num_lanes, lane = static_cast<int>(m) % T::num_lanes;
    for (int i = 0; i < shape.num_bodies; ++i) {
      const int slot = first_slot + batch * shape.num_bodies + i;
      worlds_[w].bodies[articulation->bodies[i]] = {slot, lane};
      world_at_[slot * T::num_lanes + lane] = w;
    }
    for (std::size_t j = 0; j < shape.joints.size(); ++j) {
      const int joint = batch * static_cast<int>(shape.joints.size()) + static_cast<int>(j);
      worlds_[w].joints[articulation->joints[j]] = {shape_index, joint, lane};
    }
  }
}

template <class V, class Scalar, class T>
void set_lane(Vec3L<V>& v, int lane, const model::Vec3& value) {
  T::set(v.x, lane, static_cast<Scalar>(value.x()));
  T::set(v.y, lane, static_cast<Scalar>(value.y()));
  T::set(v.z, lane, static_cast<Scalar>(value.z()));
}

template <class T>
void set_lane(Vec3L<typename T::V>& v, int lane, const model::Vec3& value) {
  set_lane<typename T::V, typename T::Scalar, T>(v, lane, value);
}

template <class T>
void set_lane(Sym3L<typename T::V>& s, int lane, const model::Mat3& m) {
  using Scalar = typename T::Scalar;
  T::set(s.xx, lane, static_cast<Scalar>(m(0, 0)));
  T::set(s.xy, lane, static_cast<Scalar>(m(0, 1)));
  T::set(s.xz, lane, static_cast<Scalar>(m(0, 2)));
  T::set(s.yy, lane, static_cast<Scalar>(m(1, 1)));
  T::set(s.yz, lane, static_cast<Scalar>(m(1, 2)));
  T::set(s.zz, lane, static_cast<Scalar>(m(2, 2)));
}

template <class T>
void WorldLanes<T>::set_masses(const World& world, int body) {
  const LanePlace& at = world.bodies[body];
  const model::Body& source = world.model->bodies[body];
  BodyLane<V>& lane = bodies.bodies[at.slot];
  T::set(lane.inv_mass, at.lane, static_cast<Scalar>(1 / source.mass_kg));
  set_lane<T>(lane.inertia_body, at.lane, source.inertia);
  set_lane<T>(lane.inv_inertia_body, at.lane, source.inertia.inverse());
  // Adding -0 changes no number, adding +0 changes -0.
  const bool falls = !world.model->gravity.isZero(0);
  set_lane<T>(gravity[at.slot], at.lane,
              falls ? world.model->gravity : model::Vec3(model::Vec3::Constant(-0.0)));
}

template <class T>
void WorldLanes<T>::find_gyroscopic(bool all_slots) {
  std::vector<GyroscopicSlot> slots(static_cast<std::size_t>(bodies.static_slot), {T::broadcast(0), 0});
  std::vector<bool> used(slots.size(), all_slots);
  for (const World& world : worlds_) {
    for (std::size_t body = 0; body < world.bodies.size(); ++body) {
      if (!model::has_gyroscopic_torque(world.model->bodies[body])) continue;
      const LanePlace& at = world.bodies[body];
      T::set(slots[static_cast<std::size_t>(at.slot)].has_torque, at.lane, 1);
      used[static_cast<std::size_t>(at.slot)] = true;
    }
  }
  for (std::size_t slot = 0; slot < used.size(); ++slot) {
    slots[slot].slot = static_cast<int>(slot);
    if (used[slot]) gyroscopic.push_back(slots[slot]);
  }
}

/// Their limits are out of reach and their motors have no force, so that their rows push nothing.
template <class T>
void WorldLanes<T>::allow_idle_controls(const Passes& passes) {
  using model::JointKind;
  for (const World& world : worlds_) {
    for (std::size_t j = 0; j < world.joints.size(); ++j) {
      const JointKind kind = world.model->joints[j].kind;
      if (kind == JointKind::ball || kind == JointKind::fixed) continue;
      const bool two_motors = kind == JointKind::universal || kind == JointKind::hinge2;
      AxisControl<V>* controls = joint_at(world, static_cast<int>(j)).controls;
      controls[0].has_limit |= passes.idle_limits;
      controls[1].has_limit |= passes.idle_limits && kind == JointKind::universal;
      controls[0].has_motor |= passes.idle_motors;
      controls[1].has_motor |= passes.idle_motors && two_motors;
    }
  }
}

template <class T>
void WorldLanes<T>::set_terms(const World& world, int joint, const JointTerms& terms) {
  const int lane = world.joints[joint].lane;
  JointTermsLane<V>& to = joint_at(world, joint).terms;
  set_lane<T>(to.anchor_a, lane, terms.anchor_a);
  set_lane<T>(to.anchor_b, lane, terms.anchor_b);
  set_lane<T>(to.axis1_a, lane, terms.axis1_a);
  set_lane<T>(to.axis1_b, lane, terms.axis1_b);
  set_lane<T>(to.axis2_b, lane, terms.axis2_b);
  set_lane<T>(to.normal1_a, lane, terms.normal1_a);
  set_lane<T>(to.normal2_b, lane, terms.normal2_b);
  T::set(to.relative_w, lane, static_cast<Scalar>(terms.relative.w));
  T::set(to.relative_x, lane, static_cast<Scalar>(terms.relative.x));
  T::set(to.relative_y, lane, static_cast<Scalar>(terms.relative.y));
  T::set(to.relative_z, lane, static_cast<Scalar>(terms.relative.z));
  T::set(to.cos0, lane, static_cast<Scalar>(terms.cos0));
  T::set(to.sin0, lane, static_cast<Scalar>(terms.sin0));
  T::set(to.stiffness, lane, static_cast<Scalar>(terms.stiffness));
  T::set(to.damping, lane, static_cast<Scalar>(terms.damping));
}

/// Idle lanes of the last batch of a shape repeat lane 0, so that they compute something harmless.
template <class T>
void WorldLanes<T>::fill_idle_lanes() {
  std::vector<int> used(bodies.bodies.size(), 0);
  for (const World& world : worlds_) {
    for (const LanePlace& at : world.bodies) used[at.slot] = std::max(used[at.slot], at.lane + 1);
  }
  const auto repeat = [](auto& lanes, int from) {
    auto* values = reinterpret_cast<V*>(&lanes);
    for (std::size_t i = 0; i < sizeof lanes / sizeof(V); ++i) {
      for (int lane = from; lane < T::num_lanes; ++lane) T::set(values[i], lane, T::get(values[i], 0));
    }
  };
  for (std::size_t slot = 0; slot + 1 < bodies.bodies.size(); ++slot) {
    repeat(bodies.bodies[slot], used[slot]);
    repeat(bodies.twists[slot], used[slot]);
  }
  for (int shape = 0; shape < joints.num_shapes(); ++shape) {
    for (JointLane<V>& joint : joints.joints(shape)) {
      const int from = used[joint.slot_a];
      repeat(joint.terms, from);
      for (AxisControl<V>& control : joint.controls) {
        for (V* v : {&control.low, &control.high, &control.sin_low, &control.cos_low, &control.sin_high,
                     &control.cos_high, &control.velocity, &control.max_force, &control.hold_rate}) {
          repeat(*v, from);
        }
      }
    }
  }
}

template <class T>
void WorldLanes<T>::load_body(int world, int body, const model::State& state) {
  const LanePlace& at = worlds_[world].bodies[body];
  set_pose(at, {state.position[body], state.orientation[body]});
  set_lane<T>(bodies.twists[at.slot].linear, at.lane, state.velocity[body]);
  set_lane<T>(bodies.twists[at.slot].angular, at.lane, state.angular_velocity[body]);
}

template <class T>
template <class Poses>
void WorldLanes<T>::store_body(int world, int body, const Poses* poses, model::State& state) const {
  const auto vector_of = [](const Vec3L<V>& v, int lane) {
    return model::Vec3(T::get(v.x, lane), T::get(v.y, lane), T::get(v.z, lane));
  };
  const LanePlace& at = worlds_[world].bodies[body];
  const Poses& lanes = poses[at.slot];
  state.position[body] = vector_of(lanes.position, at.lane);
  state.orientation[body] = {T::get(lanes.qw, at.lane), T::get(lanes.qx, at.lane), T::get(lanes.qy, at.lane),
                             T::get(lanes.qz, at.lane)};
  state.velocity[body] = vector_of(bodies.twists[at.slot].linear, at.lane);
  state.angular_velocity[body] = vector_of(bodies.twists[at.slot].angular, at.lane);
}

template <class T>
void WorldLanes<T>::update_active() {
  if (active_revision_ == active_.revision()) return;
  active_revision_ = active_.revision();
  joints.deactivate_all();
  slot_active_.assign(gravity.size(), 0);
  for (int world = 0; world < num_worlds(); ++world) {
    for (const int body : active_.of(world)) {
      const int slot = worlds_[world].bodies[body].slot;
      if (slot_active_[slot] == 0) joints.activate(slot);
      slot_active_[slot] = 1;
    }
  }
  for_each_active_slot([&](int slot) { slot_active_[slot] = 1; });
  if (!holds_bodies_) return;
  std::vector<LanePlace> held;
  for (int world = 0; world < num_worlds(); ++world) {
    for (std::size_t body = 0; body < worlds_[world].bodies.size(); ++body) {
      const LanePlace at = worlds_[world].bodies[body];
      if (slot_active_[at.slot] && !active_.contains(world, static_cast<int>(body))) held.push_back(at);
    }
  }
  held_.hold(bodies.static_slot, held);
}

template <class T>
void WorldLanes<T>::set_motor(int world, int joint, int axis, const model::AxisMotor& motor) {
  if (broken_.contains(world, joint)) return;
  const int lane = worlds_[world].joints[joint].lane;
  AxisControl<V>& control = joint_at(worlds_[world], joint).controls[axis];
  T::set(control.velocity, lane, static_cast<Scalar>(motor.velocity));
  T::set(control.max_force, lane, static_cast<Scalar>(motor.max_force));
  T::set(control.hold_rate, lane, static_cast<Scalar>(motor.hold_rate));
  control.has_motor = control.has_motor || motor.active();
  control.has_hold = control.has_hold || (motor.active() && motor.hold_rate > 0);
}

template <class T>
void WorldLanes<T>::set_limit(int world, int joint, int axis, const model::AxisLimit& limit) {
  if (broken_.contains(world, joint)) return;
  const int lane = worlds_[world].joints[joint].lane;
  AxisControl<V>& control = joint_at(worlds_[world], joint).controls[axis];
  // No stop is a stop that no angle reaches: s cos <= c sin with sin = -1, cos = 0 holds for no c > 0.
  const bool low = limit.low > -model::infinity, high = limit.high < model::infinity;
  T::set(control.low, lane, static_cast<Scalar>(low ? limit.low : -huge_bound));
  T::set(control.high, lane, static_cast<Scalar>(high ? limit.high : huge_bound));
  T::set(control.sin_low, lane, static_cast<Scalar>(low ? std::sin(limit.low / 2) : -1));
  T::set(control.cos_low, lane, static_cast<Scalar>(low ? std::cos(limit.low / 2) : 0));
  T::set(control.sin_high, lane, static_cast<Scalar>(high ? std::sin(limit.high / 2) : 1));
  T::set(control.cos_high, lane, static_cast<Scalar>(high ? std::cos(limit.high / 2) : 0));
  control.has_limit = control.has_limit || low || high;
}

template <class T>
void WorldLanes<T>::launch(int world, const model::Event& event) {
  const LanePlace& at = worlds_[world].bodies[event.body];
  set_lane<T>(bodies.twists[at.slot].linear, at.lane, event.velocity);
  set_lane<T>(bodies.twists[at.slot].angular, at.lane, event.angular_velocity);
  if (event.pose) set_pose(at, *event.pose);
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
    const JointPlace& at = worlds_[world].joints[joint];
    joints.loosen(at.shape, at.joint, at.lane);
  }
  broken_.set(world, broken_in);
  return true;
}

template <class T>
model::Reaction WorldLanes<T>::reaction(int world, int joint, double h) const {
  const JointPlace& at = worlds_[world].joints[joint];
  const model::Model& model = *worlds_[world].model;
  JointLoad load;
  joints.visit_rows(at.shape, at.joint, [&](const auto& rows) { load = load_of(rows, at.lane); });
  return reaction_of(load, model, model.joints[joint], pose(world, model.joints[joint].body_a), h);
}

template <class T>
void WorldLanes<T>::set_pose(const LanePlace& at, const model::Pose& pose) {
  BodyLane<V>& body = bodies.bodies[at.slot];
  set_lane<T>(body.position, at.lane, pose.position);
  T::set(body.qw, at.lane, static_cast<Scalar>(pose.orientation.w));
  T::set(body.qx, at.lane, static_cast<Scalar>(pose.orientation.x));
  T::set(body.qy, at.lane, static_cast<Scalar>(pose.orientation.y));
  T::set(body.qz, at.lane, static_cast<Scalar>(pose.orientation.z));
  refresh(body);
}

/// In double from the quaternion: a rotation in float makes rounding noise a contact normal in ODE's
/// colliders.
template <class T>
model::BodyPose WorldLanes<T>::pose(int world, int body) const {
  const LanePlace at = body_place(world, body);
  const BodyLane<V>& lanes = bodies.bodies[at.slot];
  model::BodyPose pose;
  pose.position[0] = T::get(lanes.position.x, at.lane);
  pose.position[1] = T::get(lanes.position.y, at.lane);
  pose.position[2] = T::get(lanes.position.z, at.lane);
  model::to_rotation(T::get(lanes.qw, at.lane), T::get(lanes.qx, at.lane), T::get(lanes.qy, at.lane),
                     T::get(lanes.qz, at.lane), pose.rotation);
  return pose;
}

template <class T>
int WorldLanes<T>::joint_rows(int world, int joint) const {
  const JointPlace& at = worlds_[world].joints[joint];
  return joints.num_rows(at.shape, at.joint, at.lane);
}

}  // namespace pbmpi::solver
