/// One step of a pack, substeps and iterations included, from the contacts to the bodies' new poses.
#pragma once

#include "core/clock.h"
#include "core/random.h"
#include "solver/contacts/contact_lists.h"
#include "solver/layout/pack_laws.h"
#include "solver/layout/passes.h"
#include "solver/pack/body_motion.h"
#include "solver/pack/contact_twists.h"
#include "solver/pack/pack.h"
#include "solver/pack/residual_meter.h"

namespace pbmpi::solver {

/// See Pack: begin(), iterate() and finish() follow each other in a step.
template <class T>
class StepLanes {
 public:
  using V = typename T::V;
  using Scalar = typename T::Scalar;
  using Contacts = std::span<const std::span<const model::Contact>>;

  /// `passes` and `worlds` are borrowed.
  StepLanes(const PackLaws& laws, const Passes& passes, WorldLanes<T>& worlds)
      : laws_(laws),
        passes_(passes),
        worlds_(worlds),
        motion_(laws, worlds),
        contacts_(frictionless_contacts(passes)) {}

  void begin(Contacts contacts, const StepParameters& parameters, core::PhaseTimes& times);
  void iterate(int iterations, core::PhaseTimes& times);
  void finish(core::PhaseTimes& times);
  void look(std::span<model::State> states);

  double h() const { return static_cast<double>(h_); }  ///< [s] a substep of the last step
  stepping::Residuals residuals(int world) const { return residuals_[static_cast<std::size_t>(world)]; }

 private:
  using Batch = typename JointBatches<T>::Batch;

  void sort_contacts(Contacts contacts);

  void damp(const Batch& batch) {
    if (passes_.damping) motion_.damp(batch, parameters_.dt_s / parameters_.substeps);
  }
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

  PackLaws laws_;
  const Passes& passes_;
  WorldLanes<T>& worlds_;
  BodyMotion<T> motion_;
  ContactLists<T> contacts_;
  ContactTwists<T> twists_;
  StepParameters parameters_;  ///< of the step at hand, with how far it has come
  int substep_ = 0, iteration_ = 0;
  Scalar h_ = 0;                                ///< [s] a substep
  std::vector<PoseLane<V>> look_poses_;         ///< [slots] scratch
  std::vector<Twist<V>> kept_twists_;           ///< [slots] scratch
  std::vector<stepping::Residuals> residuals_;  ///< [num_worlds] of the last step, if they are measured
};

template <class T>
void StepLanes<T>::sort_contacts(Contacts contacts) {
  contacts_.clear();
  for (int world = 0; world < worlds_.num_worlds(); ++world) {
    contacts_.add_world(
        worlds_.model(world).num_bodies(), contacts[static_cast<std::size_t>(world)],
        [&](int body) { return worlds_.moves(world, body); },
        [&](int body) { return worlds_.places.body(world, body); });
  }
}

template <class T>
ContactParameters<typename T::Scalar> StepLanes<T>::contact_parameters() const {
  const auto scalar = [](double value) { return static_cast<Scalar>(value); };
  return {h_,
          scalar(laws_.contact_erp) / scalar(parameters_.dt_s),
          scalar(laws_.contact_cfm),
          scalar(laws_.cfm),
          scalar(laws_.bounce_velocity),
          scalar(parameters_.sor_factor),
          passes_.restitution,
          laws_.turning_contacts,
          scalar(parameters_.warm_start)};
}

/// Rows and forces of a step, up to the first iteration.
template <class T>
void StepLanes<T>::start_step() {
  const auto scalar = [](double value) { return static_cast<Scalar>(value); };
  contacts_.build(worlds_.bodies, contact_parameters());
  const JointBuilder<T> builder(h_, scalar(laws_.erp), scalar(laws_.cfm), scalar(parameters_.sor_factor),
                                parameters_.substeps > 1);
  const GyroscopicSlot<V>* next_turning = worlds_.gyroscopic.data();
  worlds_.joints.for_each_active_batch([&](const Batch& batch) {
    motion_.apply_gyroscopic_torques(batch, scalar(parameters_.dt_s), next_turning);
    if (passes_.gravity) motion_.apply_gravity(batch, h_);
    worlds_.joints.build(batch, builder, worlds_.bodies);
  });
  worlds_.joints.stop_broken_joints();
  twists_.start(worlds_.bodies);
  iteration_ = 0;
}

/// From the last iteration of a substep to the first of the next. Batch by batch, so that its bodies and
/// joints are in the cache from pass to pass.
template <class T>
void StepLanes<T>::start_substep() {
  const auto scalar = [](double value) { return static_cast<Scalar>(value); };
  const bool carries = parameters_.warm_start > 0;
  contacts_.advance(worlds_.bodies, contact_parameters());
  const JointAdvancer<T> advancer(h_, scalar(laws_.erp), scalar(laws_.cfm), scalar(parameters_.sor_factor),
                                  scalar(parameters_.warm_start));
  worlds_.joints.for_each_active_batch([&](const Batch& batch) {
    worlds_.joints.advance(batch, advancer, worlds_.bodies);
    motion_.move_on(batch, h_);
    damp(batch);
    if (passes_.gravity) motion_.apply_gravity(batch, h_);
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
void StepLanes<T>::sweep() {
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
void StepLanes<T>::sweep_joints() {
  twists_.need_slots(worlds_.bodies);
  const JointSolver<T> solver(static_cast<Scalar>(laws_.cfm) / h_);
  if (parameters_.substeps > 1) {
    worlds_.joints.template sweep<true>(solver, worlds_.bodies);
  } else {
    worlds_.joints.template sweep<false>(solver, worlds_.bodies);
  }
  twists_.changed_slots();
}

template <class T>
void StepLanes<T>::begin(Contacts contacts, const StepParameters& parameters, core::PhaseTimes& times) {
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
void StepLanes<T>::iterate(int iterations, core::PhaseTimes& times) {
  core::LapTimer timer(times);
  for (int i = 0; i < iterations && iteration_ < parameters_.iterations; ++i) sweep();
  timer.lap(core::Phase::solve);
}

template <class T>
void StepLanes<T>::end_sweeps() {
  while (iteration_ < parameters_.iterations) sweep();
  twists_.end(worlds_.bodies);
  twists_.need_rows(worlds_.bodies);
}

/// Ends the last substep.
template <class T>
void StepLanes<T>::finish(core::PhaseTimes& times) {
  core::LapTimer timer(times);
  end_sweeps();
  if (parameters_.residuals) {
    residuals_.clear();
    for (int world = 0; world < worlds_.num_worlds(); ++world) residuals_.push_back(measure_residuals(world));
  }
  timer.lap(core::Phase::solve);
  worlds_.joints.for_each_active_batch([&](const Batch& batch) {
    motion_.move(batch, h_);
    damp(batch);
  });
  if (passes_.holds_bodies()) worlds_.restore_held();
  timer.lap(core::Phase::integrate);
}

/// Free bodies' twists lie with the contacts during the solve; what is copied of them here is overwritten
/// when it ends.
template <class T>
void StepLanes<T>::look(std::span<model::State> states) {
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
stepping::Residuals StepLanes<T>::measure_residuals(int world) const {
  ResidualMeter<T> meter(h_, laws_.cfm, contact_parameters());
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
