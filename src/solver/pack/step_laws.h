/// The numbers by which the rows of a step are built and swept.
#pragma once

#include <algorithm>

#include "solver/contacts/contact_rows.h"
#include "solver/joints/joint_builder.h"
#include "solver/joints/joint_solver.h"
#include "solver/layout/pack_laws.h"
#include "solver/layout/passes.h"
#include "solver/pack/pack.h"

namespace pbmpi::solver {

/// [m/s] With relaxing sweeps no contact pushes its bodies apart faster than this, however deep it is (as in
/// Box2D v3); no joint closes its gap, and no limit is returned to, any faster either [m/s or rad/s].
inline constexpr double fastest_push = 3;

/// [m/s] With relaxing sweeps bodies that approach, or are pushed apart, faster are solved as in an impact;
/// patches whose surfaces move along each other faster slide.
inline constexpr double slowest_impact = 0.2, slowest_slip = 0.1;

/// The laws common to the worlds of a pack and the choices of a run, combined for a step.
template <class T>
class StepLaws {
 public:
  using Scalar = typename T::Scalar;

  StepLaws(const PackLaws& laws, const Passes& passes, const StepParameters& step)
      : h_(static_cast<Scalar>(step.substep_s())),
        joint_erp_{scalar(laws.erp), scalar(laws.erp)},
        joint_cfm_(static_cast<Scalar>(laws.cfm)),
        sor_factor_(static_cast<Scalar>(step.sor_factor)),
        warm_start_(static_cast<Scalar>(step.warm_start)) {
    set_joints(step);
    set_contacts(laws, passes, step);
    if (!step.pushes) contact_law_ = RowLaw<Scalar>::relaxing();
  }

  Scalar h() const { return h_; }  ///< [s] length of a substep
  const ContactParameters<Scalar>& contacts() const { return contacts_; }
  /// The law of a sweep that corrects position errors.
  const RowLaw<Scalar>& contact_law() const { return contact_law_; }
  const JointLaws<Scalar>& joint_laws() const { return joint_laws_; }

  /// `moves`: do bodies move with the speeds that the rows leave?
  JointBuilder<T> joint_builder(bool moves) const {
    return {h_, joint_erp_, joint_cfm_, moves ? joints_ahead_s_ : 0, contacts_.push_limit};
  }
  Scalar joint_cfm() const { return joint_cfm_ / h_; }  ///< divided by the step
  JointSolver<T> joint_solver(const JointLaws<Scalar>& laws) const {
    return {joint_cfm(), sor_factor_, laws};
  }

 private:
  static Scalar scalar(double value) { return static_cast<Scalar>(value); }

  /// How many of the run's substeps one of this step stands for.
  static double length_of(const StepParameters& step) {
    return static_cast<double>(step.all_substeps) / step.substeps;
  }
  void set_joints(const StepParameters& step) {
    if (!step.joint_places.is_on()) return;
    const SpringStep places(step.joint_places, static_cast<double>(h_), length_of(step));
    const SpringStep turns(step.joint_turns, static_cast<double>(h_), length_of(step));
    joint_erp_ = {scalar(places.erp()), scalar(turns.erp())};
    Spring exact = step.joint_places;
    exact.damping_ratio = std::min(exact.damping_ratio, most_exact_damping);
    const SpringStep exact_places(exact, static_cast<double>(h_), length_of(step));
    joint_laws_ = {places.template law<Scalar>(), turns.template law<Scalar>(),
                   scalar(exact_places.erp() / places.erp())};
    joints_ahead_s_ = h_ / 2;
  }
  void set_contacts(const PackLaws& laws, const Passes& passes, const StepParameters& step) {
    contacts_ = {.h = h_,
                 .push_rate = scalar(laws.contact_erp) / scalar(step.dt_s),
                 .push_limit = scalar(step.relax > 0 ? fastest_push : huge_bound),
                 .soft_cfm = scalar(laws.contact_cfm),
                 .cfm = scalar(laws.cfm),
                 .bounce_velocity = scalar(laws.bounce_velocity),
                 .impact_velocity = scalar(step.relax > 0 ? slowest_impact : huge_bound),
                 .slip_velocity = scalar(step.relax > 0 ? slowest_slip : huge_bound),
                 .sor_factor = sor_factor_,
                 .warm_start = warm_start_,
                 .restitution = passes.restitution,
                 .turning = laws.turning_contacts,
                 .keeps_depths = !step.pushes,
                 .relaxes = step.relax > 0,
                 .cone = step.friction != stepping::Friction::pyramid};
    if (!step.contacts.is_on()) return;
    const SpringStep spring(step.contacts, static_cast<double>(h_), length_of(step));
    contacts_.push_rate = scalar(spring.erp()) / h_;
    contacts_.soft_cfm = 0;
    contact_law_ = spring.template law<Scalar>();
  }

  Scalar h_;
  JointErp<Scalar> joint_erp_;
  Scalar joint_cfm_, sor_factor_, warm_start_;
  Scalar joints_ahead_s_ = 0;  ///< of joints that are springs: see JointBuilder
  JointLaws<Scalar> joint_laws_;
  RowLaw<Scalar> contact_law_;
  ContactParameters<Scalar> contacts_;
};

}  // namespace pbmpi::solver
