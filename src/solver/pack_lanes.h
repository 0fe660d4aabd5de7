/// The pack itself, for one number type and number of lanes. Compiled once for each instruction set.
#pragma once

#include <optional>

#include "core/clock.h"
#include "core/random.h"
#include "solver/collider_lanes.h"
#include "solver/contact_lists.h"
#include "solver/passes.h"
#include "solver/slot_list.h"
#include "solver/world_lanes.h"

namespace pbmpi::solver {

template <class T>
class PackLanes final : public Pack {
 public:
  using V = typename T::V;
  using Scalar = typename T::Scalar;
  using Contacts = std::span<const std::span<const model::Contact>>;

  explicit PackLanes(std::span<const PackedWorld> worlds)
      : passes_(shared_passes(worlds)), worlds_(worlds, passes_), contacts_(passes_.idle_friction) {
    if (passes_.collision) collider_.emplace(worlds, worlds_, passes_.sleeping);
  }

  void load(int world, const model::State& state) override {
    worlds_.load(world, state);
    if (collider_) collider_->forget_boxes();
  }
  void store(int world, model::State& state) const override { worlds_.store(world, state); }
  void load(int world, std::span<const int> bodies, const model::State& state) override {
    for (const int body : bodies) worlds_.load_body(world, body, state);
    if (collider_) collider_->forget_boxes();
  }
  void store(int world, std::span<const int> bodies, model::State& state) const override {
    for (const int body : bodies) worlds_.store_body(world, body, state);
  }
  void set_active(int world, std::span<const int> bodies) override { worlds_.set_active(world, bodies); }
  void set_awake(int world, std::span<const int> bodies) override { worlds_.set_awake(world, bodies); }
  void set_motor(int world, int joint, int axis, const model::AxisMotor& motor) override {
    worlds_.set_motor(world, joint, axis, motor);
  }
  void set_limit(int world, int joint, int axis, const model::AxisLimit& limit) override {
    worlds_.set_limit(world, joint, axis, limit);
  }
  void launch(int world, const model::Event& event) override { worlds_.launch(world, event); }
  void poses(int world, std::span<model::BodyPose> poses) const override { worlds_.poses(world, poses); }
  int joint_rows(int world, int joint) const override { return worlds_.joint_rows(world, joint); }

  void collide(std::span<std::vector<model::Contact>> contacts) override {
    if (collider_) collider_->collide(worlds_, contacts);
  }
  void collide_pairs(int world, std::span<const model::GeomPair> pairs,
                     std::vector<model::Contact>& contacts) override {
    if (collider_) collider_->collide_pairs(worlds_, world, pairs, contacts);
  }
  void step(Contacts contacts, const StepParameters& parameters, core::PhaseTimes& times) override;

 private:
  void sort_contacts(Contacts contacts);
  /// Which slots of bodies are in contact, with and without joints.
  void find_contact_slots();
  void write_contact_twists(const SlotList& slots);
  void read_contact_twists(const SlotList& slots);
  void apply_gyroscopic_torques(Scalar h);
  void apply_gravity(Scalar h);
  void integrate_bodies(Scalar h);

  SlotList jointed_, free_;  ///< slots in contact
  SlotSet seen_;
  Passes passes_;
  WorldLanes<T> worlds_;
  std::optional<ColliderLanes<T>> collider_;  ///< none without the pass "collision"
  ContactLists<T> contacts_;
};

template <class T>
void PackLanes<T>::sort_contacts(Contacts contacts) {
  contacts_.clear();
  for (int world = 0; world < worlds_.num_worlds(); ++world) {
    contacts_.add_world(worlds_.model(world).num_bodies(), contacts[static_cast<std::size_t>(world)],
                        [&](int body) { return worlds_.body_place(world, body); });
  }
}

template <class T>
void PackLanes<T>::find_contact_slots() {
  jointed_.clear();
  free_.clear();
  seen_.start(worlds_.bodies.static_slot + 1);
  contacts_.for_each_body_slot([&](int slot) {
    if (slot == worlds_.bodies.static_slot || !seen_.add(slot)) return;
    (worlds_.has_joints(slot) ? jointed_ : free_).add(slot);
  });
}

template <class T>
void PackLanes<T>::write_contact_twists(const SlotList& slots) {
  for (const int slot : slots.all())
    worlds_.bodies.contact_twists.set_slot(slot, worlds_.bodies.twists[slot]);
}

template <class T>
void PackLanes<T>::read_contact_twists(const SlotList& slots) {
  for (const int slot : slots.all()) worlds_.bodies.twists[slot] = worlds_.bodies.contact_twists.slot(slot);
}

template <class T>
void PackLanes<T>::apply_gyroscopic_torques(Scalar h) {
  for (const auto& at : worlds_.gyroscopic) {
    if (worlds_.is_active(at.slot))
      apply_gyroscopic_torque<T>(worlds_.bodies.bodies[at.slot], at.has_torque,
                                 worlds_.bodies.twists[at.slot], h);
  }
}

template <class T>
void PackLanes<T>::apply_gravity(Scalar h) {
  worlds_.for_each_active_slot([&](int slot) {
    Twist<V>& twist = worlds_.bodies.twists[slot];
    twist.linear = twist.linear + worlds_.gravity[slot] * T::broadcast(h);
  });
}

template <class T>
void PackLanes<T>::integrate_bodies(Scalar h) {
  worlds_.for_each_active_slot([&](int slot) {
    integrate<T>(worlds_.bodies.bodies[slot], worlds_.bodies.twists[slot], h);
    refresh(worlds_.bodies.bodies[slot]);
  });
}

template <class T>
void PackLanes<T>::step(Contacts contacts, const StepParameters& parameters, core::PhaseTimes& times) {
  constexpr int iterations_per_order = 8;  // as ODE's quickstep
  const auto scalar = [](double value) { return static_cast<Scalar>(value); };
  const auto h = scalar(parameters.dt_s / parameters.substeps);
  const model::Model& laws = worlds_.model(0);  // the same in all worlds of a pack
  const JointBuilder<T> joint_builder(h, scalar(laws.erp), scalar(laws.cfm), scalar(parameters.sor_factor));
  const JointSolver<T> joint_solver(scalar(laws.cfm) / h);
  const ContactParameters<Scalar> contact_parameters{h,
                                                     scalar(laws.contact_law.soft_erp),
                                                     scalar(laws.contact_law.soft_cfm),
                                                     scalar(laws.cfm),
                                                     scalar(laws.contact_law.bounce_velocity),
                                                     scalar(parameters.sor_factor),
                                                     passes_.restitution};
  BodyLanes<T>& bodies = worlds_.bodies;
  core::LapTimer timer(times);
  worlds_.update_active();
  if (passes_.sleeping) worlds_.save_sleepers();
  sort_contacts(contacts);
  find_contact_slots();
  for (int substep = 0; substep < parameters.substeps; ++substep) {
    if (substep == 0) {
      contacts_.build(bodies, contact_parameters);
    } else {
      contacts_.advance(bodies, contact_parameters);
    }
    if (passes_.gyroscopic_torque) apply_gyroscopic_torques(h);
    if (passes_.gravity) apply_gravity(h);
    worlds_.joints.build(joint_builder, bodies);
    timer.lap(core::Phase::rows);
    write_contact_twists(free_);
    for (int iteration = 0; iteration < parameters.iterations; ++iteration) {
      if (iteration % iterations_per_order == 0) {
        worlds_.joints.shuffle(core::mix_key(parameters.order_key, static_cast<std::uint64_t>(substep),
                                             static_cast<std::uint64_t>(iteration)));
      }
      worlds_.joints.sweep(joint_solver, bodies);
      write_contact_twists(jointed_);
      contacts_.sweep(bodies.contact_twists, contact_parameters, iteration % 2 == 1);
      read_contact_twists(jointed_);
    }
    read_contact_twists(free_);
    timer.lap(core::Phase::solve);
    integrate_bodies(h);
    timer.lap(core::Phase::integrate);
  }
  if (passes_.sleeping) worlds_.restore_sleepers();
}

}  // namespace pbmpi::solver
