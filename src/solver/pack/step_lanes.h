/// One step of a pack, chunk by chunk, from the contacts to the bodies' new poses.
#pragma once

#include <optional>

#include "core/clock.h"
#include "core/random.h"
#include "solver/contacts/contact_groups.h"
#include "solver/joints/joint_trees.h"
#include "solver/pack/body_motion.h"
#include "solver/pack/contact_twists.h"
#include "solver/pack/newton_lanes.h"
#include "solver/pack/pack.h"
#include "solver/pack/residual_meter.h"
#include "solver/pack/step_chunks.h"
#include "solver/pack/step_laws.h"

namespace pbmpi::solver {

/// See Pack.
template <class T>
class StepLanes {
 public:
  using V = typename T::V;
  using Scalar = typename T::Scalar;
  using Contacts = Pack::Contacts;

  /// `passes` and `worlds` are borrowed.
  StepLanes(const PackLaws& laws, const Passes& passes, WorldLanes<T>& worlds)
      : pack_laws_(laws),
        passes_(passes),
        worlds_(worlds),
        motion_(laws, worlds),
        contacts_(frictionless_contacts(passes)),
        laws_(laws, passes, {}) {}

  /// Pack::step().
  void run(Contacts contacts, const StepParameters& parameters, RenewedContacts* renewed,
           core::PhaseTimes& times);

  double h() const { return static_cast<double>(laws_.h()); }  ///< [s] length of the last step's substeps
  stepping::Residuals residuals(int world) const { return residuals_[static_cast<std::size_t>(world)]; }

 private:
  using Batch = typename JointBatches<T>::Batch;

  using Chunk = typename StepChunks<T>::Chunk;

  void begin(Contacts contacts, const StepParameters& parameters, RenewedContacts* renewed);
  void find_chunks(Contacts contacts, const RenewedContacts* renewed);
  void join(const RenewedContacts& renewed);
  void touch_trees(LanePlace at) {
    if (trees_ && at.slot != worlds_.bodies.static_slot) trees_->touch(at);
  }
  void begin_chunk(int chunk);
  bool renew_contacts();
  void find_twists() {
    twists_.find(worlds_, [&](auto visit) { contacts_.for_each_body_slot(visit); });
  }
  void take(int chunk, core::LapTimer& timer);
  void damp(const Batch& batch) {
    if (passes_.damping) motion_.damp(batch, parameters_.substep_s());
  }
  bool relaxes() const { return parameters_.relax > 0; }
  bool falls() const { return passes_.gravity || !worlds_.torque.empty(); }
  bool remembers() const { return parameters_.warm_start > 0; }
  bool hands_out_forces() const { return remembers() || parameters_.show_forces; }
  void start_step();
  void build_contacts();
  void build_renewed_contacts();
  void start_substep(bool renewed);
  void need_slots(const JointLaws<Scalar>& laws);
  void end_twists(const JointLaws<Scalar>& laws) {
    need_slots(laws);
    twists_.end(worlds_.bodies);
  }
  V exact_lanes(const Batch& batch) const { return trees_ ? trees_->exact_lanes(batch) : T::broadcast(0); }
  void look_ahead();
  void push_carried();
  void sweep();
  void sweep_joints(const JointLaws<Scalar>& laws);
  using Trees = typename JointTrees<T>::Which;
  void solve_trees(Trees which, const JointSolver<T>& solver);
  void sweep_contacts(const RowLaw<Scalar>& law, int iteration);
  /// The key for the order of rows in an iteration, relaxing ones included.
  std::uint64_t order_key(int iteration) const {
    return core::mix_key(parameters_.order_key, static_cast<std::uint64_t>(substep_),
                         static_cast<std::uint64_t>(iteration));
  }
  void end_sweeps();
  void finish_by_newton();
  void choose_trees(stepping::JointSolver solver);
  /// With exact joints: prepares them for the current rows.
  void factor_joints() {
    if (trees_) trees_->factor(Trees::all, laws_.joint_cfm(), worlds_.bodies);
  }
  /// From the last sweep with bias to the end of the substep: moves the bodies, and does the relaxing sweeps.
  template <bool last>
  void end_substep();
  void relax();
  void bounce();
  void remember();
  /// For BodyMotion::move().
  const GyroscopicSlot<V>* first_turning() const { return relaxes() ? worlds_.gyroscopic.data() : nullptr; }
  static ContactKind frictionless_contacts(const Passes& passes) {
    if (passes.idle_friction) return ContactKind::rough;
    return passes.turning_contacts ? ContactKind::smooth : ContactKind::central;
  }
  stepping::Residuals measure_residuals(int world) const;

  PackLaws pack_laws_;
  const Passes& passes_;
  WorldLanes<T>& worlds_;
  BodyMotion<T> motion_;
  StepChunks<T> chunks_;
  ContactGroups<T> contacts_;  ///< of the current chunk
  ContactTwists<T> twists_;
  std::optional<JointTrees<T>> trees_;  ///< none in a step that solves no joints exactly
  ApparentMasses<T> masses_;            ///< of the current step
  StepParameters parameters_;           ///< of the current step
  StepLaws<T> laws_;                    ///< of the current step
  int substep_ = 0, iteration_ = 0;
  int renewed_slot_ = -1;  ///< of a body whose contacts are found anew in the step; -1: there is none
  std::vector<stepping::Residuals> residuals_;  ///< [num_worlds] of the last step, if measured
};

template <class T>
void StepLanes<T>::find_chunks(Contacts contacts, const RenewedContacts* renewed) {
  chunks_.start(worlds_.places, parameters_.newton || parameters_.residuals);
  if (trees_) trees_->start_step();
  for (int world = 0; world < worlds_.num_worlds(); ++world) {
    model::SolvedContacts solved = contacts[static_cast<std::size_t>(world)];
    if (!hands_out_forces()) solved.forces = {};
    contacts_.lasting().paint_world(
        worlds_.model(world).num_bodies(), solved, [&](int body) { return worlds_.moves(world, body); },
        [&](int body) { return worlds_.places.body(world, body); },
        [&](const Manifold& manifold) {
          chunks_.add(manifold);
          touch_trees(manifold.a);
          touch_trees(manifold.b);
        });
  }
  renewed_slot_ = -1;
  if (renewed != nullptr) join(*renewed);
  chunks_.cut(worlds_.active_batches());
}

/// Puts all islands that get contacts anew into one chunk. A step chooses once how it solves the joints: what
/// contacts will touch counts as touched.
template <class T>
void StepLanes<T>::join(const RenewedContacts& renewed) {
  for (int world = 0; world < worlds_.num_worlds(); ++world) {
    for (std::size_t group = 0; group < renewed.pieces().size(); ++group) {
      for (const int body : renewed.bodies(group, world)) {
        const int slot = worlds_.places.body(world, body).slot;
        if (renewed_slot_ < 0) renewed_slot_ = slot;
        chunks_.unite(renewed_slot_, slot);
      }
      for (const model::Contact& contact :
           renewed.contacts(group)[static_cast<std::size_t>(world)].contacts) {
        touch_trees(worlds_.places.body(world, contact.body_a));
        touch_trees(worlds_.places.body(world, contact.body_b));
      }
    }
    for (const int body : renewed.approaching(world)) touch_trees(worlds_.places.body(world, body));
  }
}

/// Finds the contacts of which a piece of the step begins with this substep. True if there may be any.
template <class T>
bool StepLanes<T>::renew_contacts() {
  return contacts_.renew(
      substep_, parameters_.substeps, laws_.contacts(),
      [this](int world, int body) { return worlds_.places.body(world, body); },
      [this](int world) { return worlds_.model(world).num_bodies(); });
}

template <class T>
void StepLanes<T>::build_contacts() {
  masses_.clear();
  if (trees_ && trees_->has_rotors()) {
    trees_->factor(Trees::touched, laws_.joint_cfm(), worlds_.bodies);
    trees_->lend(masses_, worlds_.bodies);
  }
  contacts_.build(worlds_.bodies, laws_.contacts());
  masses_.give_back(worlds_.bodies);
}

/// The bodies' masses in contacts are those of the step.
template <class T>
void StepLanes<T>::build_renewed_contacts() {
  find_twists();
  masses_.lend_again(worlds_.bodies);
  contacts_.build_renewed(worlds_.bodies, laws_.contacts());
  masses_.give_back(worlds_.bodies);
}

/// Twists in the slots, before joints change them or bodies move. Where contacts have acted on apparent
/// masses the articulations follow, by these laws.
template <class T>
void StepLanes<T>::need_slots(const JointLaws<Scalar>& laws) {
  const bool settles = masses_.any() && twists_.are_in_rows();
  if (settles) masses_.settle(worlds_.bodies);
  twists_.need_slots(worlds_.bodies);
  if (!settles) return;
  solve_trees(Trees::touched, laws_.joint_solver(laws));
  twists_.changed_slots();
}

/// Builds the rows and applies the forces of a step, up to the first iteration.
template <class T>
void StepLanes<T>::start_step() {
  const JointBuilder<T> builder = laws_.joint_builder(true);
  const V recalled = T::broadcast(laws_.h() * laws_.contacts().warm_start);
  worlds_.joints.for_each_active_batch([&](const Batch& batch) {
    worlds_.joints.start(batch, builder, exact_lanes(batch), recalled, worlds_.bodies);
  });
  build_contacts();
  const GyroscopicSlot<V>* next_turning = worlds_.gyroscopic.data();
  worlds_.joints.for_each_active_batch([&](const Batch& batch) {
    worlds_.joints.start_rotors(batch, worlds_.bodies);
    if (!relaxes())
      motion_.apply_gyroscopic_torques(batch, static_cast<Scalar>(parameters_.dt_s), next_turning);
    if (falls()) motion_.apply_gravity(batch, laws_.h());
  });
  look_ahead();
  factor_joints();
  push_carried();
}

/// `renewed`: contacts have been found anew.
template <class T>
void StepLanes<T>::start_substep(bool renewed) {
  const bool reduces = parameters_.warm_start != 1;
  if (reduces) contacts_.carry(laws_.contacts());
  if (renewed) build_renewed_contacts();
  look_ahead();
  worlds_.joints.for_each_active_batch([&](const Batch& batch) {
    worlds_.joints.start_rotors(batch, worlds_.bodies);
    if (falls()) motion_.apply_gravity(batch, laws_.h());
    if (reduces) worlds_.joints.carry(batch, T::broadcast(laws_.contacts().warm_start));
  });
  push_carried();
}

/// Applies what acts before the first sweep: motors at their limits, and the impulses with which the rows
/// start.
template <class T>
void StepLanes<T>::push_carried() {
  worlds_.joints.for_each_active_batch(
      [&](const Batch& batch) { worlds_.joints.push(batch, remembers(), worlds_.bodies); });
  twists_.start(worlds_.bodies);
  if (remembers()) {
    twists_.need_rows(worlds_.bodies);
    contacts_.push_carried(worlds_.bodies.contact_twists);
    twists_.changed_rows();
  }
  iteration_ = 0;
}

/// One iteration: all joints, then all contacts. Without relaxing sweeps the joints come last in a substep's
/// last iteration: an error left in them would open their gap at once and in every substep, whereas an error
/// left in a contact shows in its depth in the next substep.
template <class T>
void StepLanes<T>::sweep() {
  constexpr int iterations_per_order = 8;  // of joints, as in ODE's quickstep
  if (!parameters_.shuffled) {
    if (iteration_ == 0) worlds_.joints.order_as_given();
  } else if (iteration_ % iterations_per_order == 0) {
    worlds_.joints.shuffle(order_key(iteration_));
  }
  const bool joints_last = !relaxes() && parameters_.substeps > 1 && iteration_ + 1 == parameters_.iterations;
  if (!joints_last) sweep_joints(laws_.joint_laws());
  sweep_contacts(laws_.contact_law(), iteration_);
  if (joints_last) sweep_joints(laws_.joint_laws());
  ++iteration_;
}

template <class T>
void StepLanes<T>::sweep_contacts(const RowLaw<Scalar>& law, int iteration) {
  twists_.need_rows(worlds_.bodies);
  std::optional<std::uint64_t> key;
  if (parameters_.shuffled) key = order_key(iteration);
  const bool last = iteration + 1 == parameters_.iterations + parameters_.relax;
  contacts_.sweep(worlds_.bodies.contact_twists, laws_.contacts(), law, key, last);
  twists_.changed_rows();
}

template <class T>
void StepLanes<T>::sweep_joints(const JointLaws<Scalar>& laws) {
  need_slots(laws);
  const JointSolver<T> solver = laws_.joint_solver(laws);
  worlds_.joints.sweep(
      solver,
      [&](std::size_t shape, std::size_t batch, std::size_t joint, const auto& rows) {
        return trees_ ? trees_->swept_lanes(shape, batch, joint, rows) : T::broadcast(1);
      },
      false, worlds_.bodies);
  if (trees_) {
    if (laws.places.bias > 0 && iteration_ == 0) {
      // Only after it is known with which velocities the bodies move.
      trees_->solve(Trees::all, solver, worlds_.bodies);
      look_ahead();
    }
    solve_trees(Trees::all, solver);
  }
  twists_.changed_slots();
}

/// Limits of exact joints get several rounds, as what one leaves of them would be remembered as if it were
/// right; and always in the same order, as in a random one they would tremble at rest.
template <class T>
void StepLanes<T>::solve_trees(Trees which, const JointSolver<T>& solver) {
  trees_->solve(which, solver, worlds_.bodies);
  if (!trees_->has_limited()) return;
  constexpr int rounds = 4;
  for (int round = 0; round < rounds; ++round) {
    worlds_.joints.sweep(
        solver,
        [&](std::size_t shape, std::size_t batch, std::size_t joint, const auto& rows) {
          return trees_->limited_lanes(which, shape, batch, joint, rows);
        },
        true, worlds_.bodies);
    trees_->solve_limited(which, solver, worlds_.bodies);
  }
}

/// Sets what the rows of exact joints have ahead if the bodies move with their present twists.
template <class T>
void StepLanes<T>::look_ahead() {
  if (!trees_) return;
  const JointBuilder<T> builder = laws_.joint_builder(true);
  const GyroscopicSlot<V>* turning = first_turning();
  worlds_.joints.for_each_active_batch([&](const Batch& batch) {
    if (!T::any(exact_lanes(batch))) return;
    motion_.look_ahead(batch, laws_.h(), turning);
    worlds_.joints.look_ahead(batch, builder, worlds_.bodies);
  });
}

/// Removes the speed that corrected position errors.
template <class T>
void StepLanes<T>::relax() {
  for (int i = 0; i < parameters_.relax; ++i) {
    sweep_joints(JointLaws<Scalar>::relaxing());
    sweep_contacts(RowLaw<Scalar>::relaxing(), parameters_.iterations + i);
  }
}

/// Works batch by batch, so that a batch's bodies and joints stay in the cache from pass to pass.
template <class T>
template <bool last>
void StepLanes<T>::end_substep() {
  if (!last || relaxes()) contacts_.advance(worlds_.bodies, laws_.contacts());
  const JointBuilder<T> builder = laws_.joint_builder(!last);
  const GyroscopicSlot<V>* turning = first_turning();
  worlds_.joints.for_each_active_batch([&](const Batch& batch) {
    const V exact = exact_lanes(batch);
    motion_.template move<last>(batch, laws_.h(), exact, turning);
    if (!last || relaxes()) worlds_.joints.rebuild(batch, builder, exact, worlds_.bodies);
    if (!relaxes()) damp(batch);
  });
  if (!last || relaxes()) factor_joints();
  if (!relaxes()) return;
  twists_.start(worlds_.bodies);
  relax();
  bounce();
  need_slots(JointLaws<Scalar>::relaxing());
  twists_.need_rows(worlds_.bodies);
  contacts_.forget_open(worlds_.bodies.contact_twists, laws_.contacts());
  if (last) remember();
  end_twists(JointLaws<Scalar>::relaxing());
  worlds_.joints.for_each_active_batch([&](const Batch& batch) { damp(batch); });
}

/// One sweep over the contacts that have touched in this substep and whose bodies approached faster than the
/// threshold: what bounces flies off at once, and not only in the next step.
template <class T>
void StepLanes<T>::bounce() {
  if (!passes_.restitution) return;
  twists_.need_rows(worlds_.bodies);
  contacts_.bounce(worlds_.bodies.contact_twists, laws_.contacts());
  twists_.changed_rows();
}

template <class T>
void StepLanes<T>::remember() {
  if (!hands_out_forces()) return;
  contacts_.remember(laws_.contacts());
  const V per_h = T::broadcast(1 / laws_.h());
  worlds_.joints.for_each_active_batch([&](const Batch& batch) {
    worlds_.joints.remember(batch, per_h, [&](int slot) { return worlds_.held_lanes(slot); });
  });
}

/// Trees stay from step to step.
template <class T>
void StepLanes<T>::choose_trees(stepping::JointSolver solver) {
  if (solver == parameters_.joint_solver) return;
  trees_.reset();
  if (solver == stepping::JointSolver::sweeps) return;
  trees_.emplace(worlds_.places.shapes(), solver == stepping::JointSolver::tree, worlds_.joints);
}

template <class T>
void StepLanes<T>::begin(Contacts contacts, const StepParameters& parameters, RenewedContacts* renewed) {
  choose_trees(parameters.joint_solver);
  parameters_ = parameters;
  laws_ = {pack_laws_, passes_, parameters};
  contacts_.start(
      parameters_.friction == stepping::Friction::patch ? ContactKind::patched : ContactKind::rough, renewed);
  worlds_.update_active();
  if (passes_.holds_bodies()) worlds_.save_held();
  find_chunks(contacts, renewed);
}

/// Everything before the sweeps of the first substep.
template <class T>
void StepLanes<T>::begin_chunk(int chunk) {
  const Chunk parts = chunks_[chunk];
  worlds_.joints.activate(parts.batches);
  contacts_.begin_chunk(parts.manifolds, renewed_slot_ >= 0 && chunks_.chunk_at(renewed_slot_) == chunk);
  substep_ = 0;
  renew_contacts();
  find_twists();
  start_step();
}

template <class T>
void StepLanes<T>::end_sweeps() {
  while (iteration_ < parameters_.iterations) sweep();
  end_twists(laws_.joint_laws());
  if (parameters_.newton) finish_by_newton();
  twists_.need_rows(worlds_.bodies);
}

template <class T>
void StepLanes<T>::finish_by_newton() {
  NewtonLanes<T>(laws_.joint_cfm(), laws_.contacts()).solve(worlds_, contacts_);
  twists_.start(worlds_.bodies);
}

template <class T>
void StepLanes<T>::run(Contacts contacts, const StepParameters& parameters, RenewedContacts* renewed,
                       core::PhaseTimes& times) {
  core::LapTimer timer(times);
  begin(contacts, parameters, renewed);
  for (int chunk = 0; chunk < chunks_.size(); ++chunk) take(chunk, timer);
  if (passes_.holds_bodies()) worlds_.restore_held();
  timer.lap(core::Phase::integrate);
}

template <class T>
void StepLanes<T>::take(int chunk, core::LapTimer& timer) {
  begin_chunk(chunk);
  timer.lap(core::Phase::rows);
  while (substep_ + 1 < parameters_.substeps) {
    end_sweeps();
    end_substep<false>();
    timer.lap(core::Phase::solve);
    ++substep_;
    const bool renewed = renew_contacts();
    if (renewed) timer.lap(core::Phase::collide);
    start_substep(renewed);
    timer.lap(core::Phase::rows);
  }
  end_sweeps();
  if (parameters_.residuals) {
    residuals_.clear();
    for (int world = 0; world < worlds_.num_worlds(); ++world) residuals_.push_back(measure_residuals(world));
  }
  if (!relaxes()) remember();
  timer.lap(core::Phase::solve);
  end_substep<true>();
  timer.lap(core::Phase::integrate);
}

template <class T>
stepping::Residuals StepLanes<T>::measure_residuals(int world) const {
  ResidualMeter<T> meter(laws_.h(), pack_laws_.cfm, laws_.contacts());
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
