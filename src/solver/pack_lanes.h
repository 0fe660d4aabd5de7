/// The pack itself, for one number type and number of lanes. Compiled once for each instruction set.
#pragma once

#include <optional>
#include <type_traits>

#include "core/clock.h"
#include "core/random.h"
#include "solver/collider_lanes.h"
#include "solver/contact_lists.h"
#include "solver/passes.h"
#include "solver/residual_meter.h"
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
  void begin_step(Contacts contacts, const StepParameters& parameters, core::PhaseTimes& times) override;
  void iterate(int iterations, core::PhaseTimes& times) override;
  void finish_step(core::PhaseTimes& times) override;
  void look(std::span<model::State> states) override;
  model::Residuals residuals(int world) const override { return residuals_[static_cast<std::size_t>(world)]; }

 private:
  void sort_contacts(Contacts contacts);
  /// Which slots of bodies are in contact, with and without joints.
  void find_contact_slots();
  void write_contact_twists(const SlotList& slots);
  void read_contact_twists(const SlotList& slots);
  void apply_gyroscopic_torques(Scalar h);
  void apply_gravity(Scalar h);
  void integrate_bodies(Scalar h);
  void damp(double h);
  void start_substep();
  void sweep();
  ContactParameters<Scalar> contact_parameters() const;
  model::Residuals measure_residuals(int world) const;

  StepParameters parameters_;  ///< of the step at hand, with how far it has come
  int substep_ = 0, iteration_ = 0;
  Scalar h_ = 0;                             ///< [s] a substep
  std::vector<PoseLane<V>> look_poses_;      ///< [slots] scratch
  std::vector<Twist<V>> kept_twists_;        ///< [slots] scratch
  std::vector<model::Residuals> residuals_;  ///< [num_worlds] of the last step, if they are measured
  SlotList jointed_, free_;                  ///< slots in contact
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
    contacts_.add_world(
        worlds_.model(world).num_bodies(), contacts[static_cast<std::size_t>(world)],
        [&](int body) { return worlds_.moves(world, body); },
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

/// As ODE after it has moved a body: v <- (1 - scale) v. The scale of a step of any length is that of an
/// exponential decay.
template <class T>
void PackLanes<T>::damp(double h) {
  const model::Model& laws = worlds_.model(0);  // the same in all worlds of a pack
  const V linear = T::broadcast(static_cast<Scalar>(std::exp(-laws.linear_damping * h)));
  const V angular = T::broadcast(static_cast<Scalar>(std::exp(-laws.angular_damping * h)));
  worlds_.for_each_active_slot([&](int slot) {
    Twist<V>& twist = worlds_.bodies.twists[slot];
    twist = {twist.linear * linear, twist.angular * angular};
  });
}

template <class T>
ContactParameters<typename T::Scalar> PackLanes<T>::contact_parameters() const {
  const auto scalar = [](double value) { return static_cast<Scalar>(value); };
  const model::Model& laws = worlds_.model(0);  // the same in all worlds of a pack
  return {h_,
          scalar(laws.contact_law.soft_erp),
          scalar(laws.contact_law.soft_cfm),
          scalar(laws.cfm),
          scalar(laws.contact_law.bounce_velocity),
          scalar(parameters_.sor_factor),
          passes_.restitution,
          scalar(parameters_.warm_start)};
}

/// Rows and forces, up to the first iteration.
template <class T>
void PackLanes<T>::start_substep() {
  const auto scalar = [](double value) { return static_cast<Scalar>(value); };
  const model::Model& laws = worlds_.model(0);
  BodyLanes<T>& bodies = worlds_.bodies;
  const bool carries = substep_ > 0 && parameters_.warm_start > 0;
  if (substep_ == 0) {
    contacts_.build(bodies, contact_parameters());
  } else {
    contacts_.advance(bodies, contact_parameters());
  }
  if (passes_.gyroscopic_torque) apply_gyroscopic_torques(h_);
  if (passes_.gravity) apply_gravity(h_);
  const auto build_joints = [&](auto later) {
    const JointBuilder<T, later> builder(h_, scalar(laws.erp), scalar(laws.cfm),
                                         scalar(parameters_.sor_factor), scalar(parameters_.warm_start));
    worlds_.joints.build(builder, carries, bodies);
  };
  substep_ == 0 ? build_joints(std::false_type()) : build_joints(std::true_type());
  write_contact_twists(free_);
  if (carries) {
    write_contact_twists(jointed_);
    contacts_.push_carried(bodies.contact_twists);
    read_contact_twists(jointed_);
  }
  iteration_ = 0;
}

/// One iteration: all joints, then all contacts.
template <class T>
void PackLanes<T>::sweep() {
  constexpr int iterations_per_order = 8;  // as ODE's quickstep
  BodyLanes<T>& bodies = worlds_.bodies;
  if (!parameters_.shuffled) {
    if (iteration_ == 0) worlds_.joints.order_as_given();
  } else if (iteration_ % iterations_per_order == 0) {
    worlds_.joints.shuffle(core::mix_key(parameters_.order_key, static_cast<std::uint64_t>(substep_),
                                         static_cast<std::uint64_t>(iteration_)));
  }
  worlds_.joints.sweep(JointSolver<T>(static_cast<Scalar>(worlds_.model(0).cfm) / h_), bodies);
  write_contact_twists(jointed_);
  contacts_.sweep(bodies.contact_twists, contact_parameters(), iteration_ % 2 == 1);
  read_contact_twists(jointed_);
  ++iteration_;
}

template <class T>
void PackLanes<T>::begin_step(Contacts contacts, const StepParameters& parameters, core::PhaseTimes& times) {
  parameters_ = parameters;
  h_ = static_cast<Scalar>(parameters.dt_s / parameters.substeps);
  core::LapTimer timer(times);
  worlds_.update_active();
  if (passes_.holds_bodies()) worlds_.save_held();
  sort_contacts(contacts);
  find_contact_slots();
  substep_ = 0;
  start_substep();
  timer.lap(core::Phase::rows);
  while (substep_ + 1 < parameters.substeps) {
    finish_step(times);
    timer = core::LapTimer(times);
    ++substep_;
    start_substep();
    timer.lap(core::Phase::rows);
  }
}

template <class T>
void PackLanes<T>::iterate(int iterations, core::PhaseTimes& times) {
  core::LapTimer timer(times);
  for (int i = 0; i < iterations && iteration_ < parameters_.iterations; ++i) sweep();
  timer.lap(core::Phase::solve);
}

/// Ends the substep at hand.
template <class T>
void PackLanes<T>::finish_step(core::PhaseTimes& times) {
  core::LapTimer timer(times);
  while (iteration_ < parameters_.iterations) sweep();
  read_contact_twists(free_);
  const bool last = substep_ + 1 == parameters_.substeps;
  if (parameters_.residuals && last) {
    residuals_.clear();
    for (int world = 0; world < worlds_.num_worlds(); ++world) residuals_.push_back(measure_residuals(world));
  }
  timer.lap(core::Phase::solve);
  integrate_bodies(h_);
  if (!last) worlds_.joints.advance(h_, worlds_.bodies);
  if (passes_.damping) damp(parameters_.dt_s / parameters_.substeps);
  if (last && passes_.holds_bodies()) worlds_.restore_held();
  timer.lap(core::Phase::integrate);
}

/// Free bodies' twists lie with the contacts during the solve; what is copied of them here is overwritten
/// when it ends.
template <class T>
void PackLanes<T>::look(std::span<model::State> states) {
  read_contact_twists(free_);
  look_poses_.resize(worlds_.gravity.size());
  worlds_.for_each_active_slot([&](int slot) {
    const BodyLane<V>& body = worlds_.bodies.bodies[slot];
    PoseLane<V>& pose = look_poses_[static_cast<std::size_t>(slot)];
    pose = {body.position, body.qw, body.qx, body.qy, body.qz};
    integrate<T>(pose, worlds_.bodies.twists[slot], h_);
  });
  std::vector<Twist<V>>& twists = worlds_.bodies.twists;
  if (passes_.damping) {
    kept_twists_ = twists;
    damp(parameters_.dt_s / parameters_.substeps);
  }
  for (std::size_t world = 0; world < states.size(); ++world)
    worlds_.store_with(look_poses_.data(), static_cast<int>(world), states[world]);
  if (passes_.damping) twists = kept_twists_;
}

template <class T>
model::Residuals PackLanes<T>::measure_residuals(int world) const {
  ResidualMeter<T> meter(h_, worlds_.model(0).cfm, contact_parameters());
  worlds_.visit_joint_rows(world,
                           [&](const auto& rows, int lane) { meter.add_joint(rows, worlds_.bodies, lane); });
  contacts_.visit_slots([&](const auto& slot, const auto* points, const Manifold* manifolds) {
    meter.add_contacts(slot, points, worlds_.bodies.contact_twists, [&](int lane, int point) {
      return point < manifolds[lane].num_points && worlds_.world_at(manifolds[lane].a) == world;
    });
  });
  return meter.result();
}

}  // namespace pbmpi::solver
