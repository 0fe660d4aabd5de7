/// One world in an engine that holds joints by constraints between bodies.
#pragma once

#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "effects/fast_bodies.h"
#include "model/contact.h"
#include "model/islands.h"
#include "model/state.h"
#include "stepping/engine/engine_world.h"
#include "stepping/engine/touch.h"
#include "stepping/observables.h"
#include "stepping/step_profile.h"

namespace pbmpi::stepping {

/// Counts from the joints and contacts, for engines that show neither their rows nor their islands. To be
/// used between collision detection and the solver, since limits become active according to the poses before
/// the step.
class RowCounter {
 public:
  /// Scalar rows of a joint in the step.
  using RowsOfJoint = std::function<int(int joint)>;

  /// `model` is borrowed.
  explicit RowCounter(const model::Model& model) : model_(&model), sets_(model.num_bodies()) {}

  /// Sets rows, islands and max_island_rows. `state`: its `rest` and `broken_in` are current; sleeping bodies
  /// have no rows.
  void count(const std::vector<Touch>& touches, const model::State& state, const RowsOfJoint& rows_of_joint,
             Observables& observables);
  /// Sum over the islands of the last count() of their rows times their sweeps; sweeps(body) is called with
  /// an island's lowest body.
  template <class Sweeps>
  double row_visits(Sweeps sweeps) const {
    double visits = 0;
    for (std::size_t body = 0; body < set_rows_.size(); ++body) {
      if (set_rows_[body] > 0)
        visits += static_cast<double>(set_rows_[body]) * sweeps(static_cast<int>(body));
    }
    return visits;
  }
  /// The islands of the last count(), in order of their lowest body, without times.
  std::vector<IslandCost> islands(const std::vector<Touch>& touches);
  /// The lowest body of the island that contained `body`.
  int island_of(int body) { return sets_.find(body); }

 private:
  /// Rows between two bodies, either of which may be no_body.
  struct Link {
    int body_a, body_b, rows;
  };
  void collect(const std::vector<Touch>& touches, const model::State& state,
               const RowsOfJoint& rows_of_joint);

  const model::Model* model_;
  std::vector<Link> links_;
  model::DisjointSets sets_;
  std::vector<int> set_rows_;  ///< [num_bodies], at the lowest body of each island
};

/// The part of such a world that needs no engine: its events, its motors, what sleeps in it, what is read of
/// it. Bodies and joints have the model's numbers.
///
/// The engine's own deactivation of bodies must be off: bodies sleep by State::rest. A broken joint is
/// disabled and keeps its place.
class JointedWorld : public EngineWorld {
 public:
  void set_state(const model::State& state) final;
  void aim(const MotorTargets::Target& target) final;
  void read(model::State& state, Observables& observables) final;

 protected:
  /// As EngineWorld's. Throws core::InputError for a joint that is not of its kind: a motor or limit on an
  /// axis that the kind lacks, or a hinge2 to the world.
  JointedWorld(const model::Model& model, MotorTargets& targets, const model::State& state, std::int64_t step,
               const StepperSettings& settings, std::optional<int> iterations);
  /// To be called at the end of the engine's constructor, with the joints as the model has them: brings them
  /// to their settings at the start of step(), before that step's own events, and sets the state. Throws
  /// core::InputError for a motor or steer event on an axis that its joint lacks.
  void start(const model::State& state);

  /// Gives all bodies their poses and velocities.
  virtual void restore(const model::State& state) = 0;
  /// Gives the body of a launch event its pose, if it has one, and its velocities.
  virtual void launch(const model::Event& event) = 0;
  /// `axis`: 0 or 1, as in the model.
  virtual void drive(int joint, int axis, const model::AxisMotor& motor) = 0;
  /// Limits axis 0 of a joint.
  virtual void limit(int joint, const model::AxisLimit& limit) = 0;
  /// Angle [rad] or length [m] of an axis for the present poses.
  virtual double coordinate(int joint, int axis) = 0;
  /// Scalar rows of a joint in a step from the present poses.
  virtual int count_rows(int joint) = 0;
  virtual const std::vector<Touch>& touches() const = 0;
  /// [m] Depth of the deepest contact; 0 without contacts.
  virtual double deepest_m() const = 0;
  /// The step has no contacts.
  virtual void forget_contacts() = 0;
  /// [m] Of a body's centre of mass.
  virtual model::Vec3 centre(int body) const = 0;
  struct Velocities {
    model::Vec3 linear, angular;  ///< [m/s], [rad/s]
  };
  virtual Velocities velocities(int body) const = 0;
  /// Adds speculative contacts, gaps that may close in the step.
  virtual void make_ahead(const std::vector<model::Contact>& contacts) = 0;
  /// Appends the contacts of the step that was solved, with their forces. `before`: note_centres().
  virtual void append_contacts(std::span<const model::Vec3> before,
                               std::vector<model::LoadedContact>& contacts) const = 0;
  /// What a joint exerted in that step.
  virtual model::JointForce joint_force(int joint) const = 0;

  bool may_be_fast() const final;
  void add_speculative_contacts(effects::FastBodies& fast, const model::State& before) final;
  void fire_events(std::int64_t step) final;
  std::span<const effects::BodyPair> touching() final;
  bool is_driven(int joint) const final { return targets_->drive(*model_, step_ + 1, joint); }

  /// Sets the targets of the motors that hold a pose from the present poses, to be called in each step: the
  /// engine's motors know only a velocity.
  void aim_held();
  /// Takes a step in which all bodies sleep and which no event wakes: it changes nothing.
  void sleep_on(bool is_last);
  /// The pairs with at least one awake geom.
  const std::vector<model::GeomPair>& awake_pairs(const std::vector<model::GeomPair>& pairs);
  /// Sets rows and islands of `counts_`.
  void count();
  /// Around the solve of a step whose contacts are to be shown: notes where bodies are, and fills `shown_`.
  void note_centres();
  void show_contacts();

  RowCounter row_counter_;
  bool moved_ = true;  ///< since the last read()

 private:
  struct Held {
    int joint, axis;
    model::AxisMotor motor;
  };
  void apply(const model::Event& event);
  void set_motor(int joint, int axis, const model::AxisMotor& motor);
  void hold(int joint, int axis, const model::AxisMotor& motor);

  std::vector<Held> held_;                       ///< motors with a hold rate
  std::size_t next_event_ = 0;                   ///< in Model::events
  std::vector<effects::SlowBound> slow_bounds_;  ///< [bodies]
  std::vector<model::Vec3> centres_;             ///< [bodies] at note_centres()
  std::vector<model::Contact> ahead_;            ///< scratch
  std::vector<model::GeomPair> awake_pairs_;     ///< scratch
  std::vector<effects::BodyPair> touching_;      ///< scratch
};

}  // namespace pbmpi::stepping
