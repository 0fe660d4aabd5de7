/// The pack itself, for one number type and number of lanes. Compiled once for each instruction set.
#pragma once

#include <optional>
#include <type_traits>

#include "core/clock.h"
#include "core/random.h"
#include "solver/contacts/contact_lists.h"
#include "solver/layout/passes.h"
#include "solver/pack/collider_lanes.h"
#include "solver/pack/contact_twists.h"
#include "solver/pack/residual_meter.h"
#include "solver/pack/world_lanes.h"

namespace pbmpi::solver {

template <class T>
class PackLanes final : public Pack {
 public:
  using V = typename T::V;
  using Scalar = typename T::Scalar;
  using Contacts = std::span<const std::span<const model::Contact>>;

  explicit PackLanes(std::span<const PackedWorld> worlds)
      : passes_(shared_passes(worlds)), worlds_(worlds, passes_), contacts_(frictionless_contacts(passes_)) {
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
  void set_broken(int world, std::span<const std::int32_t> broken_in) override {
    if (worlds_.set_broken(world, broken_in) && collider_) collider_->set_broken(world, broken_in);
  }
  effects::Reaction reaction(int world, int joint) const override {
    return worlds_.reaction(world, joint, static_cast<double>(h_));
  }
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
  stepping::Residuals residuals(int world) const override {
    return residuals_[static_cast<std::size_t>(world)];
  }

 private:
  void sort_contacts(Contacts contacts);
  using Batch = typename JointBatches<T>::Batch;
  using GyroscopicSlot = typename WorldLanes<T>::GyroscopicSlot;

  void move(const Batch& batch);
  void move_on(const Batch& batch);
  void damp(const Batch& batch);
  void apply_gyroscopic_torques(const Batch& batch, const GyroscopicSlot*& next);
  void apply_gravity(const Batch& batch);
  void start_step();
  void start_substep();
  void sweep();
  void sweep_joints();
  void end_sweeps();
  static ContactKind frictionless_contacts(const Passes& passes) {
    if (passes.idle_friction) return ContactKind::rough;
    return passes.turning_contacts ? ContactKind::smooth : ContactKind::central;
  }
  ContactParameters<Scalar> contact_parameters() const;
  stepping::Residuals measure_residuals(int world) const;

  StepParameters parameters_;  ///< of the step at hand, with how far it has come
  int substep_ = 0, iteration_ = 0;
  Scalar h_ = 0;                                ///< [s] a substep
  std::vector<PoseLane<V>> look_poses_;         ///< [slots] scratch
  std::vector<Twist<V>> kept_twists_;           ///< [slots] scratch
  std::vector<stepping::Residuals> residuals_;  ///< [num_worlds] of the last step, if they are measured
  ContactTwists<T> twists_;
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
        [&](int body) { return worlds_.places.body(world, body); });
  }
}

/// `next`: the first slot with the torque that no batch before had; goes on to that of the next batch.
template <class T>
void PackLanes<T>::apply_gyroscopic_torques(const Batch& batch, const GyroscopicSlot*& next) {
  const GyroscopicSlot* const end = worlds_.gyroscopic.data() + worlds_.gyroscopic.size();
  const auto dt = static_cast<Scalar>(parameters_.dt_s);
  while (next != end && next->slot < batch.first_slot) ++next;
  for (; next != end && next->slot < batch.end_slot; ++next)
    apply_gyroscopic_torque<T>(worlds_.bodies.bodies[next->slot], next->has_torque,
                               worlds_.bodies.twists[next->slot], dt);
}

template <class T>
void PackLanes<T>::apply_gravity(const Batch& batch) {
  for (int slot = batch.first_slot; slot < batch.end_slot; ++slot) {
    Twist<V>& twist = worlds_.bodies.twists[slot];
    twist.linear = twist.linear + worlds_.gravity[slot] * T::broadcast(h_);
  }
}

template <class T>
void PackLanes<T>::move(const Batch& batch) {
  for (int slot = batch.first_slot; slot < batch.end_slot; ++slot) {
    integrate<T, true>(worlds_.bodies.bodies[slot], worlds_.bodies.twists[slot], h_);
    refresh(worlds_.bodies.bodies[slot]);
  }
}

/// Between two substeps. Inertia in the world's frame, and with it the gyroscopic torque, stays that of the
/// step's start, as in a step without substeps.
template <class T>
void PackLanes<T>::move_on(const Batch& batch) {
  for (int slot = batch.first_slot; slot < batch.end_slot; ++slot) {
    BodyLane<V>& body = worlds_.bodies.bodies[slot];
    integrate<T, false>(body, worlds_.bodies.twists[slot], h_);
    body.rotation = to_matrix(body.qw, body.qx, body.qy, body.qz);
  }
}

/// As ODE after it has moved a body: v <- (1 - scale) v. The scale of a step of any length is that of an
/// exponential decay.
template <class T>
void PackLanes<T>::damp(const Batch& batch) {
  const model::Model& laws = worlds_.model(0);  // the same in all worlds of a pack
  const double h = parameters_.dt_s / parameters_.substeps;
  const V linear = T::broadcast(static_cast<Scalar>(std::exp(-laws.linear_damping * h)));
  const V angular = T::broadcast(static_cast<Scalar>(std::exp(-laws.angular_damping * h)));
  for (int slot = batch.first_slot; slot < batch.end_slot; ++slot) {
    Twist<V>& twist = worlds_.bodies.twists[slot];
    twist = {twist.linear * linear, twist.angular * angular};
  }
}

template <class T>
ContactParameters<typename T::Scalar> PackLanes<T>::contact_parameters() const {
  const auto scalar = [](double value) { return static_cast<Scalar>(value); };
  const model::Model& laws = worlds_.model(0);  // the same in all worlds of a pack
  return {h_,
          scalar(laws.contact_law.soft_erp) / scalar(parameters_.dt_s),
          scalar(laws.contact_law.soft_cfm),
          scalar(laws.cfm),
          scalar(laws.contact_law.bounce_velocity),
          scalar(parameters_.sor_factor),
          passes_.restitution,
          passes_.turning_contacts,
          scalar(parameters_.warm_start)};
}

/// Rows and forces of a step, up to the first iteration.
template <class T>
void PackLanes<T>::start_step() {
  const auto scalar = [](double value) { return static_cast<Scalar>(value); };
  const model::Model& laws = worlds_.model(0);
  contacts_.build(worlds_.bodies, contact_parameters());
  const JointBuilder<T> builder(h_, scalar(laws.erp), scalar(laws.cfm), scalar(parameters_.sor_factor),
                                parameters_.substeps > 1);
  const GyroscopicSlot* next_turning = worlds_.gyroscopic.data();
  worlds_.joints.for_each_active_batch([&](const Batch& batch) {
    apply_gyroscopic_torques(batch, next_turning);
    if (passes_.gravity) apply_gravity(batch);
    worlds_.joints.build(batch, builder, worlds_.bodies);
  });
  worlds_.joints.loosen_broken();
  twists_.start(worlds_.bodies);
  iteration_ = 0;
}

/// From the last iteration of a substep to the first of the next. Batch by batch, so that its bodies and
/// joints are in the cache from pass to pass.
template <class T>
void PackLanes<T>::start_substep() {
  const auto scalar = [](double value) { return static_cast<Scalar>(value); };
  const model::Model& laws = worlds_.model(0);
  const bool carries = parameters_.warm_start > 0;
  contacts_.advance(worlds_.bodies, contact_parameters());
  const JointAdvancer<T> advancer(h_, scalar(laws.erp), scalar(laws.cfm), scalar(parameters_.sor_factor),
                                  scalar(parameters_.warm_start));
  worlds_.joints.for_each_active_batch([&](const Batch& batch) {
    worlds_.joints.advance(batch, advancer, worlds_.bodies);
    move_on(batch);
    if (passes_.damping) damp(batch);
    if (passes_.gravity) apply_gravity(batch);
    worlds_.joints.rebuild(batch, advancer, carries, worlds_.bodies);
  });
  twists_.start(worlds_.bodies);
  if (carries) {
    twists_.need_rows(worlds_.bodies);
    contacts_.push_carried(worlds_.bodies.contact_twists);
    twists_.changed_rows();
  }
  iteration_ = 0;
}

/// One iteration: all joints, then all contacts. In the last one of a substep the joints come last: what is
/// left of their error would open the gap at once and in every substep, whereas the next substep sees the
/// depth that is left of a contact's.
template <class T>
void PackLanes<T>::sweep() {
  constexpr int iterations_per_order = 8;  // as ODE's quickstep
  if (!parameters_.shuffled) {
    if (iteration_ == 0) worlds_.joints.order_as_given();
  } else if (iteration_ % iterations_per_order == 0) {
    worlds_.joints.shuffle(core::mix_key(parameters_.order_key, static_cast<std::uint64_t>(substep_),
                                         static_cast<std::uint64_t>(iteration_)));
  }
  const bool joints_last = parameters_.substeps > 1 && iteration_ + 1 == parameters_.iterations;
  if (!joints_last) sweep_joints();
  twists_.need_rows(worlds_.bodies);
  contacts_.sweep(worlds_.bodies.contact_twists, contact_parameters(), iteration_ % 2 == 1);
  twists_.changed_rows();
  if (joints_last) sweep_joints();
  ++iteration_;
}

/// With substeps the rows of a joint that hold its place come after those that hold its angles, which would
/// open what is closed.
template <class T>
void PackLanes<T>::sweep_joints() {
  twists_.need_slots(worlds_.bodies);
  const JointSolver<T> solver(static_cast<Scalar>(worlds_.model(0).cfm) / h_);
  if (parameters_.substeps > 1) {
    worlds_.joints.template sweep<true>(solver, worlds_.bodies);
  } else {
    worlds_.joints.template sweep<false>(solver, worlds_.bodies);
  }
  twists_.changed_slots();
}

template <class T>
void PackLanes<T>::begin_step(Contacts contacts, const StepParameters& parameters, core::PhaseTimes& times) {
  parameters_ = parameters;
  h_ = static_cast<Scalar>(parameters.dt_s / parameters.substeps);
  core::LapTimer timer(times);
  worlds_.update_active();
  if (passes_.holds_bodies()) worlds_.save_held();
  sort_contacts(contacts);
  twists_.find(worlds_, [&](auto visit) { contacts_.for_each_body_slot(visit); });
  substep_ = 0;
  start_step();
  timer.lap(core::Phase::rows);
  while (substep_ + 1 < parameters.substeps) {
    end_sweeps();
    timer.lap(core::Phase::solve);
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

template <class T>
void PackLanes<T>::end_sweeps() {
  while (iteration_ < parameters_.iterations) sweep();
  twists_.end(worlds_.bodies);
  twists_.need_rows(worlds_.bodies);
}

/// Ends the last substep.
template <class T>
void PackLanes<T>::finish_step(core::PhaseTimes& times) {
  core::LapTimer timer(times);
  end_sweeps();
  if (parameters_.residuals) {
    residuals_.clear();
    for (int world = 0; world < worlds_.num_worlds(); ++world) residuals_.push_back(measure_residuals(world));
  }
  timer.lap(core::Phase::solve);
  worlds_.joints.for_each_active_batch([&](const Batch& batch) {
    move(batch);
    if (passes_.damping) damp(batch);
  });
  if (passes_.holds_bodies()) worlds_.restore_held();
  timer.lap(core::Phase::integrate);
}

/// Free bodies' twists lie with the contacts during the solve; what is copied of them here is overwritten
/// when it ends.
template <class T>
void PackLanes<T>::look(std::span<model::State> states) {
  twists_.end(worlds_.bodies);
  look_poses_.resize(worlds_.gravity.size());
  worlds_.for_each_active_slot([&](int slot) {
    const BodyLane<V>& body = worlds_.bodies.bodies[slot];
    PoseLane<V>& pose = look_poses_[static_cast<std::size_t>(slot)];
    pose = {body.position, body.qw, body.qx, body.qy, body.qz};
    integrate<T, true>(pose, worlds_.bodies.twists[slot], h_);
  });
  std::vector<Twist<V>>& twists = worlds_.bodies.twists;
  if (passes_.damping) {
    kept_twists_ = twists;
    worlds_.joints.for_each_active_batch([&](const Batch& batch) { damp(batch); });
  }
  for (std::size_t world = 0; world < states.size(); ++world)
    worlds_.store_with(look_poses_.data(), static_cast<int>(world), states[world]);
  if (passes_.damping) twists = kept_twists_;
}

template <class T>
stepping::Residuals PackLanes<T>::measure_residuals(int world) const {
  ResidualMeter<T> meter(h_, worlds_.model(0).cfm, contact_parameters());
  worlds_.visit_joint_rows(world,
                           [&](const auto& rows, int lane) { meter.add_joint(rows, worlds_.bodies, lane); });
  contacts_.visit_slots([&](const auto& slot, const auto* points, const Manifold* manifolds) {
    meter.add_contacts(slot, points, worlds_.bodies.contact_twists, [&](int lane, int point) {
      return point < manifolds[lane].num_points && worlds_.places.world_at(manifolds[lane].a) == world;
    });
  });
  return meter.result();
}

}  // namespace pbmpi::solver
