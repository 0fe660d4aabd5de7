/// The pack itself, for one number type and number of lanes. Compiled once for each instruction set.
#pragma once

#include <algorithm>
#include <map>
#include <numeric>
#include <utility>
#include <vector>

#include "core/clock.h"
#include "core/random.h"
#include "model/geometry.h"
#include "solver/contact_colors.h"
#include "solver/contact_lanes.h"
#include "solver/joint_lanes.h"
#include "solver/pack.h"

namespace pbmpi::solver {

/// Copies of one shape in the lanes of consecutive batches.
template <class T>
struct ShapeBatches {
  using V = typename T::V;
  ArticulationShape shape;
  int first_slot = 0;  ///< slot of body i in batch k: first_slot + k * num_bodies + i
  int num_batches = 0;
  std::vector<JointLane<V>> joints;  ///< [num_batches][shape.joints]
  std::vector<int> order;            ///< of the joints within a batch, in this sweep
};

template <class T>
class PackLanes final : public Pack {
 public:
  using V = typename T::V;
  using Scalar = typename T::Scalar;
  using Contacts = std::span<const std::span<const model::Contact>>;

  explicit PackLanes(std::span<const PackedWorld> worlds);

  void load(int world, const model::State& state) override;
  void store(int world, model::State& state) const override;
  void set_motor(int world, int joint, int axis, const model::AxisMotor& motor) override;
  void set_limit(int world, int joint, int axis, const model::AxisLimit& limit) override;
  void launch(int world, const model::Event& event) override;
  void poses(int world, std::span<model::BodyPose> poses) const override;
  void step(Contacts contacts, const StepParameters& parameters, core::PhaseTimes& times) override;
  int joint_rows(int world, int joint) const override;
  int num_lanes() const override { return T::num_lanes; }

 private:
  struct Place {
    int slot = 0;  ///< of a body; of a joint: index into joints_of(shape)
    int lane = 0;
    int shape = 0;
  };
  struct World {
    const model::Model* model = nullptr;
    std::vector<Place> bodies, joints;
  };
  /// Contacts of one kind: with or without a second body, with or without friction.
  struct ContactList {
    std::vector<PlacedContact> placed;  ///< by colour, then by world
    std::vector<int> first;             ///< of each slot; one more at the end
    std::vector<ContactSlot<T>> slots;
  };

  void place(std::span<const PackedWorld> worlds);
  void set_masses(const World& world, int body);
  void set_pose(const Place& at, const model::Pose& pose);
  void set_terms(const World& world, int joint, const JointTerms& terms);
  void add_joint_rows(ShapeBatches<T>& batches);
  void fill_idle_lanes();
  JointLane<V>& joint_at(const World& world, int joint) {
    const Place& at = world.joints[joint];
    return shapes_[at.shape].joints[at.slot];
  }

  void sort_contacts(Contacts contacts);
  void fill_slots(ContactList& list, Contacts contacts, bool two_bodies, bool friction);
  template <class Visit>
  void for_each_list(Visit visit);
  void build_contacts(const ContactParameters<Scalar>& parameters);
  void advance_contacts(const ContactParameters<Scalar>& parameters);
  void apply_forces(Scalar h);
  void build_joints(const JointSolver<T>& solver);
  void shuffle_joints(std::uint64_t key);
  void sweep_joints(const JointSolver<T>& solver);
  void sweep_contacts(bool backwards);
  void integrate_bodies(Scalar h);

  std::vector<World> worlds_;
  std::vector<ShapeBatches<T>> shapes_;
  BodyLanes<T> bodies_{0};
  std::vector<Vec3L<V>> gravity_;  ///< [slots] worlds may differ
  std::vector<PointRows<V>> points_;
  std::vector<AxisRow<V>> axes_;
  std::vector<BoundedLine<V>> lines_;
  ContactList lists_[2][2];  ///< [two bodies][friction]
  ContactColors painter_;
};

template <class T>
PackLanes<T>::PackLanes(std::span<const PackedWorld> worlds) {
  place(worlds);
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
  fill_idle_lanes();
  for (BodyLane<V>& body : bodies_.bodies) refresh(body);
}

/// Gives each body a slot and a lane, shape by shape, world by world.
template <class T>
void PackLanes<T>::place(std::span<const PackedWorld> worlds) {
  std::map<ArticulationShape, std::vector<std::pair<int, const Articulation*>>> copies;
  for (std::size_t w = 0; w < worlds.size(); ++w) {
    worlds_.push_back({worlds[w].model, std::vector<Place>(worlds[w].model->bodies.size()),
                       std::vector<Place>(worlds[w].model->joints.size())});
    for (const Articulation& articulation : worlds[w].articulations) {
      copies[articulation.shape].emplace_back(static_cast<int>(w), &articulation);
    }
  }
  int num_slots = 0;
  for (const auto& [shape, members] : copies) {
    ShapeBatches<T> batches;
    batches.shape = shape;
    batches.first_slot = num_slots;
    batches.num_batches = (static_cast<int>(members.size()) + T::num_lanes - 1) / T::num_lanes;
    batches.joints.resize(shape.joints.size() * static_cast<std::size_t>(batches.num_batches));
    batches.order.resize(shape.joints.size());
    std::iota(batches.order.begin(), batches.order.end(), 0);
    const int shape_index = static_cast<int>(shapes_.size());
    for (std::size_t m = 0; m < members.size(); ++m) {
      const auto [w, articulation] = members[m];
      const int batch = static_cast<int>(m) / T::num_lanes, lane = static_cast<int>(m) % T::num_lanes;
      for (int i = 0; i < shape.num_bodies; ++i) {
        worlds_[w].bodies[articulation->bodies[i]] = {num_slots + batch * shape.num_bodies + i, lane,
                                                      shape_index};
      }
      for (std::size_t j = 0; j < shape.joints.size(); ++j) {
        const int index = batch * static_cast<int>(shape.joints.size()) + static_cast<int>(j);
        worlds_[w].joints[articulation->joints[j]] = {index, lane, shape_index};
      }
    }
    num_slots += batches.num_batches * shape.num_bodies;
    shapes_.push_back(std::move(batches));
  }
  bodies_ = BodyLanes<T>(num_slots);
  gravity_.assign(static_cast<std::size_t>(num_slots), {T::broadcast(0), T::broadcast(0), T::broadcast(0)});
  for (ShapeBatches<T>& batches : shapes_) add_joint_rows(batches);
}

template <class T>
void PackLanes<T>::add_joint_rows(ShapeBatches<T>& batches) {
  const std::size_t num_joints = batches.shape.joints.size();
  for (std::size_t index = 0; index < batches.joints.size(); ++index) {
    JointLane<V>& joint = batches.joints[index];
    joint.link = batches.shape.joints[index % num_joints];
    const int first = batches.first_slot + static_cast<int>(index / num_joints) * batches.shape.num_bodies;
    joint.slot_a = first + joint.link.body_a;
    joint.slot_b =
        joint.link.body_b == batches.shape.num_bodies ? bodies_.static_slot : first + joint.link.body_b;
    const bool slider = joint.link.kind == model::JointKind::slider;
    const bool hinge2 = joint.link.kind == model::JointKind::hinge2;
    if (!slider && !hinge2) {
      joint.point = static_cast<int>(points_.size());
      points_.emplace_back();
    }
    joint.first_axis = static_cast<int>(axes_.size());
    joint.num_axes = fixed_axes(joint.link.kind);
    joint.first_line = static_cast<int>(lines_.size());
    joint.num_lines = hinge2 ? 3 : (slider ? 2 : 0);
    axes_.resize(axes_.size() +
                 static_cast<std::size_t>(joint.num_axes + (slider ? 0 : num_controls(joint.link.kind))));
    lines_.resize(lines_.size() + static_cast<std::size_t>(joint.num_lines + (slider ? 1 : 0)));
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
void PackLanes<T>::set_masses(const World& world, int body) {
  const Place& at = world.bodies[body];
  const model::Body& source = world.model->bodies[body];
  BodyLane<V>& lane = bodies_.bodies[at.slot];
  T::set(lane.inv_mass, at.lane, static_cast<Scalar>(1 / source.mass_kg));
  set_lane<T>(lane.inertia_body, at.lane, source.inertia);
  set_lane<T>(lane.inv_inertia_body, at.lane, source.inertia.inverse());
  set_lane<T>(gravity_[at.slot], at.lane, world.model->gravity);
}

template <class T>
void PackLanes<T>::set_terms(const World& world, int joint, const JointTerms& terms) {
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
void PackLanes<T>::fill_idle_lanes() {
  std::vector<int> used(bodies_.bodies.size(), 0);
  for (const World& world : worlds_) {
    for (const Place& at : world.bodies) used[at.slot] = std::max(used[at.slot], at.lane + 1);
  }
  const auto repeat = [](auto& lanes, int from) {
    auto* values = reinterpret_cast<V*>(&lanes);
    for (std::size_t i = 0; i < sizeof lanes / sizeof(V); ++i) {
      for (int lane = from; lane < T::num_lanes; ++lane) T::set(values[i], lane, T::get(values[i], 0));
    }
  };
  for (std::size_t slot = 0; slot + 1 < bodies_.bodies.size(); ++slot) {
    repeat(bodies_.bodies[slot], used[slot]);
    repeat(bodies_.twists[slot], used[slot]);
  }
  for (ShapeBatches<T>& batches : shapes_) {
    for (JointLane<V>& joint : batches.joints) {
      const int from = used[joint.slot_a];
      repeat(joint.terms, from);
      for (AxisControl<V>& control : joint.controls) {
        for (V* v : {&control.low, &control.high, &control.sin_low, &control.cos_low, &control.sin_high,
                     &control.cos_high, &control.velocity, &control.max_force}) {
          repeat(*v, from);
        }
      }
    }
  }
}

template <class T>
void PackLanes<T>::load(int world, const model::State& state) {
  for (std::size_t i = 0; i < worlds_[world].bodies.size(); ++i) {
    const Place& at = worlds_[world].bodies[i];
    set_pose(at, {state.position[i], state.orientation[i]});
    set_lane<T>(bodies_.twists[at.slot].linear, at.lane, state.velocity[i]);
    set_lane<T>(bodies_.twists[at.slot].angular, at.lane, state.angular_velocity[i]);
  }
}

template <class T>
void PackLanes<T>::store(int world, model::State& state) const {
  const auto vector_of = [](const Vec3L<V>& v, int lane) {
    return model::Vec3(T::get(v.x, lane), T::get(v.y, lane), T::get(v.z, lane));
  };
  for (std::size_t i = 0; i < worlds_[world].bodies.size(); ++i) {
    const Place& at = worlds_[world].bodies[i];
    const BodyLane<V>& body = bodies_.bodies[at.slot];
    state.position[i] = vector_of(body.position, at.lane);
    state.orientation[i] = {T::get(body.qw, at.lane), T::get(body.qx, at.lane), T::get(body.qy, at.lane),
                            T::get(body.qz, at.lane)};
    state.velocity[i] = vector_of(bodies_.twists[at.slot].linear, at.lane);
    state.angular_velocity[i] = vector_of(bodies_.twists[at.slot].angular, at.lane);
  }
}

template <class T>
void PackLanes<T>::set_motor(int world, int joint, int axis, const model::AxisMotor& motor) {
  const int lane = worlds_[world].joints[joint].lane;
  AxisControl<V>& control = joint_at(worlds_[world], joint).controls[axis];
  T::set(control.velocity, lane, static_cast<Scalar>(motor.velocity));
  T::set(control.max_force, lane, static_cast<Scalar>(motor.max_force));
  control.has_motor = control.has_motor || motor.active();
}

template <class T>
void PackLanes<T>::set_limit(int world, int joint, int axis, const model::AxisLimit& limit) {
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
void PackLanes<T>::launch(int world, const model::Event& event) {
  const Place& at = worlds_[world].bodies[event.body];
  set_lane<T>(bodies_.twists[at.slot].linear, at.lane, event.velocity);
  set_lane<T>(bodies_.twists[at.slot].angular, at.lane, event.angular_velocity);
  if (event.pose) set_pose(at, *event.pose);
}

template <class T>
void PackLanes<T>::set_pose(const Place& at, const model::Pose& pose) {
  BodyLane<V>& body = bodies_.bodies[at.slot];
  set_lane<T>(body.position, at.lane, pose.position);
  T::set(body.qw, at.lane, static_cast<Scalar>(pose.orientation.w));
  T::set(body.qx, at.lane, static_cast<Scalar>(pose.orientation.x));
  T::set(body.qy, at.lane, static_cast<Scalar>(pose.orientation.y));
  T::set(body.qz, at.lane, static_cast<Scalar>(pose.orientation.z));
  refresh(body);
}

template <class T>
void PackLanes<T>::poses(int world, std::span<model::BodyPose> poses) const {
  for (std::size_t i = 0; i < poses.size(); ++i) {
    const Place& at = worlds_[world].bodies[i];
    const BodyLane<V>& body = bodies_.bodies[at.slot];
    const double p[3] = {T::get(body.position.x, at.lane), T::get(body.position.y, at.lane),
                         T::get(body.position.z, at.lane)};
    std::copy_n(p, 3, poses[i].position);
    // In double from the quaternion: a rotation in float makes rounding noise a contact normal in ODE's
    // colliders.
    model::to_rotation(T::get(body.qw, at.lane), T::get(body.qx, at.lane), T::get(body.qy, at.lane),
                       T::get(body.qz, at.lane), poses[i].rotation);
  }
}

template <class T>
template <class Visit>
void PackLanes<T>::for_each_list(Visit visit) {
  visit(lists_[0][0], std::false_type{}, std::false_type{});
  visit(lists_[0][1], std::false_type{}, std::true_type{});
  visit(lists_[1][0], std::true_type{}, std::false_type{});
  visit(lists_[1][1], std::true_type{}, std::true_type{});
}

/// Contacts of one kind, colour by colour over all worlds, cut into slots.
template <class T>
void PackLanes<T>::fill_slots(ContactList& list, Contacts contacts, bool two_bodies, bool friction) {
  std::vector<std::vector<PlacedContact>> by_color;
  std::vector<std::pair<int, int>> links;
  std::vector<const model::Contact*> chosen;
  std::vector<int> colors;
  for (std::size_t w = 0; w < contacts.size(); ++w) {
    const World& world = worlds_[w];
    links.clear();
    chosen.clear();
    for (const model::Contact& contact : contacts[w]) {
      if ((contact.body_b != model::no_body) != two_bodies || (contact.mu > 0) != friction) continue;
      links.emplace_back(contact.body_a, contact.body_b);
      chosen.push_back(&contact);
    }
    if (chosen.empty()) continue;
    const int num_colors = painter_.paint(world.model->num_bodies(), links, colors);
    if (by_color.size() < static_cast<std::size_t>(num_colors))
      by_color.resize(static_cast<std::size_t>(num_colors));
    for (std::size_t i = 0; i < chosen.size(); ++i) {
      const Place& a = world.bodies[links[i].first];
      const Place b = two_bodies ? world.bodies[links[i].second] : Place{bodies_.static_slot, 0, 0};
      by_color[colors[i]].push_back({chosen[i], a.slot, a.lane, b.slot, b.lane});
    }
  }
  list.placed.clear();
  list.first.clear();
  for (const auto& color : by_color) {
    for (std::size_t begin = 0; begin < color.size(); begin += T::num_lanes) {
      list.first.push_back(static_cast<int>(list.placed.size()));
      const std::size_t end = std::min(color.size(), begin + T::num_lanes);
      list.placed.insert(list.placed.end(), color.begin() + static_cast<std::ptrdiff_t>(begin),
                         color.begin() + static_cast<std::ptrdiff_t>(end));
    }
  }
  list.slots.resize(list.first.size());
  list.first.push_back(static_cast<int>(list.placed.size()));
}

template <class T>
void PackLanes<T>::sort_contacts(Contacts contacts) {
  for_each_list([&](ContactList& list, auto two_bodies, auto friction) {
    fill_slots(list, contacts, two_bodies.value, friction.value);
  });
}

template <class T>
void PackLanes<T>::build_contacts(const ContactParameters<Scalar>& parameters) {
  for_each_list([&](ContactList& list, auto two_bodies, auto friction) {
    for (std::size_t i = 0; i < list.slots.size(); ++i) {
      ContactSolver<T, two_bodies.value, friction.value>::build(list.placed.data() + list.first[i],
                                                                list.first[i + 1] - list.first[i], bodies_,
                                                                parameters, list.slots[i]);
    }
  });
}

template <class T>
void PackLanes<T>::advance_contacts(const ContactParameters<Scalar>& parameters) {
  for_each_list([&](ContactList& list, auto two_bodies, auto friction) {
    for (ContactSlot<T>& slot : list.slots) {
      ContactSolver<T, two_bodies.value, friction.value>::advance(bodies_, parameters, slot);
    }
  });
}

template <class T>
void PackLanes<T>::apply_forces(Scalar h) {
  for (int slot = 0; slot < bodies_.static_slot; ++slot) {
    Twist<V>& twist = bodies_.twists[slot];
    apply_gyroscopic_torque<T>(bodies_.bodies[slot], twist, h);
    twist.linear = twist.linear + gravity_[slot] * T::broadcast(h);
  }
}

template <class T>
void PackLanes<T>::build_joints(const JointSolver<T>& solver) {
  for (ShapeBatches<T>& batches : shapes_) {
    for (JointLane<V>& joint : batches.joints) solver.build(joint, bodies_, points_, axes_, lines_);
  }
}

/// Fisher-Yates with keyed numbers: the same order in every batch of a shape, so in every world.
template <class T>
void PackLanes<T>::shuffle_joints(std::uint64_t key) {
  for (ShapeBatches<T>& batches : shapes_) {
    std::iota(batches.order.begin(), batches.order.end(), 0);
    for (std::size_t i = batches.order.size(); i > 1; --i) {
      std::swap(batches.order[i - 1], batches.order[core::mix_key(key, i, 0) % i]);
    }
  }
}

template <class T>
void PackLanes<T>::sweep_joints(const JointSolver<T>& solver) {
  for (ShapeBatches<T>& batches : shapes_) {
    const int num_joints = static_cast<int>(batches.shape.joints.size());
    for (int batch = 0; batch < batches.num_batches; ++batch) {
      for (int joint : batches.order)
        solver.solve(batches.joints[batch * num_joints + joint], bodies_, points_, axes_, lines_);
    }
  }
}

template <class T>
void PackLanes<T>::sweep_contacts(bool backwards) {
  for_each_list([&](ContactList& list, auto two_bodies, auto friction) {
    using Solver = ContactSolver<T, two_bodies.value, friction.value>;
    if (backwards) {
      for (auto slot = list.slots.rbegin(); slot != list.slots.rend(); ++slot) Solver::solve(bodies_, *slot);
    } else {
      for (ContactSlot<T>& slot : list.slots) Solver::solve(bodies_, slot);
    }
  });
}

template <class T>
void PackLanes<T>::integrate_bodies(Scalar h) {
  for (int slot = 0; slot < bodies_.static_slot; ++slot) {
    integrate<T>(bodies_.bodies[slot], bodies_.twists[slot], h);
    refresh(bodies_.bodies[slot]);
  }
}

template <class T>
int PackLanes<T>::joint_rows(int world, int joint) const {
  const Place& at = worlds_[world].joints[joint];
  const JointLane<V>& lanes = shapes_[at.shape].joints[at.slot];
  int rows = (lanes.point >= 0 ? 3 : 0) + lanes.num_axes + lanes.num_lines;
  for (int i = 0; i < 2; ++i) {
    if (!lanes.control_rows[i]) continue;
    const bool slider = lanes.link.kind == model::JointKind::slider;
    const V& low =
        slider ? lines_[lanes.first_line + 2].low : axes_[lanes.first_axis + lanes.num_axes + i].low;
    const V& high =
        slider ? lines_[lanes.first_line + 2].high : axes_[lanes.first_axis + lanes.num_axes + i].high;
    rows += T::get(low, at.lane) < T::get(high, at.lane) ? 1 : 0;
  }
  return rows;
}

template <class T>
void PackLanes<T>::step(Contacts contacts, const StepParameters& parameters, core::PhaseTimes& times) {
  constexpr int iterations_per_order = 8;  // as ODE's quickstep
  const auto h = static_cast<Scalar>(parameters.dt_s / parameters.substeps);
  const model::Model& first = *worlds_.front().model;
  const auto cfm = static_cast<Scalar>(first.cfm);
  const auto factor = static_cast<Scalar>(parameters.sor_factor);
  const JointSolver<T> joint_solver(h, static_cast<Scalar>(first.erp), cfm, factor);
  const ContactParameters<Scalar> contact_parameters{h,
                                                     static_cast<Scalar>(first.contact_law.soft_erp),
                                                     static_cast<Scalar>(first.contact_law.soft_cfm),
                                                     cfm,
                                                     static_cast<Scalar>(first.contact_law.bounce_velocity),
                                                     factor};
  core::LapTimer timer(times);
  sort_contacts(contacts);
  for (int substep = 0; substep < parameters.substeps; ++substep) {
    if (substep == 0) {
      build_contacts(contact_parameters);
    } else {
      advance_contacts(contact_parameters);
    }
    apply_forces(h);
    build_joints(joint_solver);
    timer.lap(core::Phase::rows);
    for (int iteration = 0; iteration < parameters.iterations; ++iteration) {
      if (iteration % iterations_per_order == 0) {
        shuffle_joints(core::mix_key(parameters.order_key, static_cast<std::uint64_t>(substep),
                                     static_cast<std::uint64_t>(iteration)));
      }
      sweep_joints(joint_solver);
      sweep_contacts(iteration % 2 == 1);
    }
    timer.lap(core::Phase::solve);
    integrate_bodies(h);
    timer.lap(core::Phase::integrate);
  }
}

}  // namespace pbmpi::solver
