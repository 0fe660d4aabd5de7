/// The interface through which worlds are stepped, whatever the engine.
#pragma once

#include <cstdint>
#include <memory>
#include <string_view>

#include "core/clock.h"
#include "model/model.h"
#include "model/state.h"
#include "stepping/observables.h"
#include "stepping/step_contacts.h"
#include "stepping/step_profile.h"

namespace pbmpi::stepping {

/// quick and direct are ODE's, sor is pbmpi's own; bullet and mujoco belong to engines that a build may lack
/// (engines/optional_engines.h).
enum class StepperKind { quick, direct, sor, bullet, mujoco };

/// Number type of the sor stepper; the others are double.
enum class Precision { double_, single };

/// Vector instructions of the sor stepper; all give the same bits. automatic: the widest that the machine
/// has.
enum class Simd { automatic, sse2, avx2, avx512, off };

/// What collides pairs of geoms in the sor stepper: kernels over vector lanes (and ODE's dCollide for shapes
/// that they do not handle), or dCollide for all.
enum class Colliders { lanes, ode };

/// The order of rows in the sweeps of the sor stepper: shuffled by the step's key, joints every 8 iterations
/// (as in ODE's quickstep) and contacts in each iteration, or the model's order in all.
enum class RowOrder { shuffled, fixed };

/// How friction is bounded: at each contact along each of two axes separately (the pyramid of ODE's
/// dContactApprox1, which holds 1.41 times as much along its diagonal); at each contact equally in all
/// directions (the cone of Coulomb's law); or jointly for all contacts of two bodies that lie in one plane,
/// with their twist about the normal.
enum class Friction { pyramid, cone, patch };

/// Which articulations the sor stepper solves exactly in a sweep, except for limits, motors and the joints
/// that close loops; it solves the joints of the others one after the other. `hanging`: articulations that
/// joints hold to something static, that have armatures, or whose joints sweeps hardly hold, as long as
/// nothing touches these. An articulation that stands on contacts gains nothing from exact joints alone: its
/// contacts see the foot and not the body.
enum class JointSolver { sweeps, hanging, tree };

/// Which equations the sor stepper solves: those of soft constraints, ODE's, or ODE's with Coulomb's cones of
/// friction.
enum class Law { soft, ode, coulomb };

/// The equations of the sor stepper, and how its sweeps solve them: by default, those of `Law::soft`. A run
/// chooses one of the laws; their parts can be chosen one by one in C++ only.
struct SorLaw {
  Law name = Law::soft;
  double sor_factor = 1;  ///< over-relaxation, above 0 and below 2
  double warm_start = 1;  ///< share of the last step's or substep's forces that is taken over, 0 to 1
  int relax = 1;          ///< sweeps at the end of a substep that push nothing out
  /// [Hz] Frequency of contacts as springs; infinite: as stiff as a substep bears; 0: the scene's ERP and
  /// CFM.
  double contact_frequency = model::infinity;
  double contact_damping = 20;               ///< damping ratio of contacts as springs
  double joint_frequency = model::infinity;  ///< [Hz] frequency of joints as springs, likewise
  double joint_damping = 3;                  ///< damping ratio of joints as springs
  double contact_margin = 1;                 ///< contacts are found up to so many g dt^2 apart
  Friction friction = Friction::patch;
  bool newton = false;  ///< Newton's method ends the sweeps over rigid rows, on each island; needs cones
  JointSolver joint_solver = JointSolver::hanging;
  int most_substeps = 32;  ///< the most for tall islands, if above StepperSettings::substeps
  RowOrder row_order = RowOrder::shuffled;
  Colliders colliders = Colliders::lanes;

  bool operator==(const SorLaw&) const = default;
};

/// ODE's equations: rigid rows with the scene's ERP and CFM, friction in pyramids, and no memory, so that
/// each step begins from nothing, like those of dWorldQuickStep.
constexpr SorLaw ode_law() {
  return {.name = Law::ode,
          .sor_factor = 1.3,  // built into QuickStep
          .warm_start = 0,
          .relax = 0,
          .contact_frequency = 0,
          .joint_frequency = 0,
          .contact_margin = 0,
          .friction = Friction::pyramid,
          .joint_solver = JointSolver::sweeps};
}

/// ODE's equations with cones of friction, solved to rounding.
constexpr SorLaw coulomb_law() {
  SorLaw law = ode_law();
  law.name = Law::coulomb;
  law.friction = Friction::cone;
  law.newton = true;
  return law;
}

constexpr SorLaw law_named(Law name) {
  if (name == Law::soft) return {};
  return name == Law::ode ? ode_law() : coulomb_law();
}

/// What a run chooses about the step; the rest is in the Model. By default that of sor with its soft law;
/// default_settings() has those of the other steppers.
struct StepperSettings {
  StepperKind kind = StepperKind::sor;
  double dt_s = 0.01;
  int iterations = 1;      ///< sweeps of an iterative solver, in each substep
  int substeps = 14;       ///< sor: parts of a step without new collision detection
  double tolerance_m = 0;  ///< sor: islands that move less get fewer substeps; 0: all get all of them
  /// sor with a memory: islands in which bodies approach each other by more than this in a step take it in
  /// pieces with contacts of their own [m]; 0: none does
  double approach_m = 0.1;
  SorLaw law = {};  ///< sor; the others have ode_law()
  Precision precision = Precision::double_;
  Simd simd = Simd::automatic;
  int threads = 1;         ///< sor: that step packs of worlds at the same time; moves no bit
  bool profile = false;    ///< ODE's: keep what profile_last_step() needs
  bool residuals = false;  ///< sor: measure Observables::residuals
  bool contacts = false;   ///< keep what WorldStepper::contacts() shows; moves no bit
  std::uint64_t seed = 1;  ///< of the run; a step's random numbers come from (seed, world, step)
};

/// Sweeps in a step, relaxing ones included.
constexpr int sweeps_of(const StepperSettings& settings) {
  return (settings.iterations + settings.law.relax) * settings.substeps;
}

/// [s] Length of a substep.
constexpr double substep_s(const StepperSettings& settings) { return settings.dt_s / settings.substeps; }

/// What acts on a body besides all that its model has, world frame.
struct BodyLoad {
  model::Vec3 force = model::Vec3::Zero();   ///< [N] on the centre of mass
  model::Vec3 torque = model::Vec3::Zero();  ///< [N m]
  bool operator==(const BodyLoad&) const = default;
};

/// Steps the worlds that one rank owns. A world's result depends on nothing but its model, its state, the
/// step number and the settings: not on the other worlds, nor on the order of the calls.
class WorldStepper {
 public:
  virtual ~WorldStepper() = default;

  /// Takes in a world whose state is that at the start of step `step` (0 = initial_state(model)). A world may
  /// come from another rank at any step boundary: the state restores it bit for bit.
  virtual void add(int world, std::shared_ptr<const model::Model> model, const model::State& state,
                   std::int64_t step) = 0;
  virtual void remove(int world) = 0;
  /// Puts a world into another state, that at the start of step `step`: what follows is the same, bit for
  /// bit, as after remove() and add(), and cheap if the world is at that step.
  virtual void set_state(int world, const model::State& state, std::int64_t step) = 0;

  /// From the next step on the motor of an axis aims at `velocity` [rad/s or m/s], until the next such call
  /// or event of this axis, or until the world is removed. The model must have a motor there, at the start or
  /// by an event. Not part of the state: whoever puts a world back sets its targets again. Throws
  /// core::InputError where there is no such motor.
  virtual void set_motor_velocity(int world, int joint, int axis, double velocity);

  /// From the next step on the load acts on the body throughout each step, until the next such call, or until
  /// the world is removed. A sleeping island wakes if it is another load than before. Not part of the state:
  /// whoever puts a world back sets its loads again. Throws core::InputError if the stepper takes no loads.
  virtual void set_load(int world, int body, const BodyLoad& load);

  /// Steps every world `num_steps` times and refreshes state(), observables() and cost_s(). Adds the seconds
  /// spent to `times`. 0 steps only get ready for the next, after worlds have come, gone or changed.
  virtual void advance(int num_steps, core::PhaseTimes& times) = 0;

  virtual const model::State& state(int world) const = 0;
  virtual const model::Model& model(int world) const = 0;
  virtual const Observables& observables(int world) const = 0;
  /// Seconds that the last advance() spent on this world.
  virtual double cost_s(int world) const = 0;

  /// Contacts and forces of the last step of the last advance(); null unless StepperSettings::contacts asks
  /// for them, or of a world that has stopped.
  virtual const StepContacts* contacts(int world) const {
    static_cast<void>(world);
    return nullptr;
  }

  /// Measures the last step of the last advance() again, island by island; no state changes by a bit. For
  /// steppers made with StepperSettings::profile, others do nothing.
  virtual void profile_last_step() {}
  /// What it found, until the next call; null if nothing was measured.
  virtual const StepProfile* profile(int world) const {
    static_cast<void>(world);
    return nullptr;
  }
};

}  // namespace pbmpi::stepping
