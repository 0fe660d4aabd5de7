/// Many worlds of one scene, stepped together: pbmpi without its programs.
///
/// Only this header and what it includes are meant to stay as they are. SI units, world frame, z up;
/// orientations are (w, x, y, z). Bad input throws std::invalid_argument with a message that says what is
/// wrong, where and what to do; a run that fails throws std::runtime_error.
#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "pbmpi/export.h"

namespace pbmpi {

/// Changes to the scene for one world: "ACTOR.KEY", "JOINT.KEY" or "world.KEY", as a scene file has them, and
/// the value as TOML, e.g. {"car.speed", "12.5"}, {"world.gravity", "[0, 0, -1.62]"}.
using Parameters = std::map<std::string, std::string>;

/// What a batch is made of.
struct BatchOptions {
  /// A scene that pbmpi brings ("CrashSk", `pbmpi --list-scenes`), or the path of a file: .toml
  /// (scenes/FORMAT.md), .xml (MJCF) or .urdf.
  std::string scene;
  /// The text of a scene file, instead of a file to read; `scene` then only names it.
  std::string scene_text;
  int num_worlds = 0;  ///< over all ranks together; 0: as many as the scene says
  std::uint64_t seed = 1;
  /// Options of a step as pbmpi's command line has them, without dashes: {"stepper", "sor"}, {"precision",
  /// "single"}, {"dt", "0.005"}, {"threads", "4"}, {"effects", "+sleeping,-friction"}. Options left out keep
  /// pbmpi's defaults.
  std::map<std::string, std::string> settings;
  /// [num_worlds], or empty: each world's changes to the scene.
  std::vector<Parameters> parameters;
  /// MPI_Comm_c2f() of the communicator over whose ranks the worlds are dealt out in blocks; the caller
  /// initialises MPI. Without a communicator the batch calls no MPI.
  std::optional<int> communicator;
};

/// Poses and velocities of this rank's worlds: [num_local_worlds][num_bodies][k], contiguous, in the order of
/// world_ids() and body_names().
struct BatchState {
  std::vector<double> position;          ///< k = 3 [m], centres of mass
  std::vector<double> orientation;       ///< k = 4 (w, x, y, z)
  std::vector<double> velocity;          ///< k = 3 [m/s]
  std::vector<double> angular_velocity;  ///< k = 3 [rad/s]
};

/// An axis of a joint.
struct JointAxis {
  std::string name;     ///< the joint's, followed by "/2" for a second axis
  bool slides = false;  ///< its coordinate is a length [m] and its effort a force [N], not [rad] and [N m]
};

/// Where the joints of this rank's worlds are: [num_local_worlds][num_joint_axes], in the order of
/// joint_axes(). Positive is the joint's first body turning or moving along the axis against the second.
struct BatchJoints {
  std::vector<double> position;  ///< [rad], within half a turn, or [m]: since the world's first step
  std::vector<double> velocity;  ///< [rad/s] or [m/s]
};

/// An axis that a motor drives.
struct Motor {
  std::string name;      ///< the joint's, followed by "/2" for a second axis
  double max_force = 0;  ///< at the start; [N m], [N] for a slider
  double hold_rate = 0;  ///< [1/s] at which it returns to its target, at the start; 0: it holds no pose
};

/// The worlds that this rank owns, out of all worlds of the batch. Calls marked "collective" are made by all
/// ranks of the communicator in the same order. The bits of a world depend on scene, seed, parameters,
/// settings and step alone: not on the other worlds, on the number of ranks or of threads, nor on when it was
/// reset.
class PBMPI_EXPORT Batch {
 public:
  /// Collective.
  explicit Batch(const BatchOptions& options);
  ~Batch();
  Batch(Batch&&) noexcept;
  Batch& operator=(Batch&&) noexcept;

  int num_worlds() const;                  ///< over all ranks
  int num_local_worlds() const;            ///< on this rank
  std::span<const int> world_ids() const;  ///< [num_local_worlds], ascending
  int num_bodies() const;                  ///< per world; all worlds have the same bodies
  std::span<const std::string> body_names() const;
  double dt_s() const;
  int steps_per_frame() const;  ///< the scene's: a frame is 1/30 s
  /// [num_local_worlds] steps since each world's start.
  std::span<const std::int64_t> steps() const;

  /// Steps all worlds. Sends no message between ranks.
  void step(int num_steps = 1);

  /// Poses and velocities as they are now; this call copies them out of the steppers' lanes, once after a
  /// step. The reference and its arrays' addresses stay valid until the batch ends.
  const BatchState& state();
  /// Replaces poses and velocities. Forces that a step hands on to the next and all state of sleeping,
  /// breaking and other memory are kept, as in a world that somebody pushed: a sleeping island wakes if one
  /// of its bodies has another pose or velocity than before. `mask`: [num_local_worlds], the worlds to set;
  /// empty: all.
  void set_state(const BatchState& state, std::span<const bool> mask = {});

  /// Worlds begin anew, at step 0, with `seed` and with new changes to the scene ([num_local_worlds]; empty:
  /// the changes each had), bit for bit as in a new batch. Worlds outside `mask` go on. The solver also draws
  /// from `seed`, unless the setting "solver-seed" is chosen. Only worlds of one solver seed and one step lie
  /// side by side in vector lanes, unless the setting "row-order" is "fixed": choose "fixed" where worlds
  /// begin anew one by one.
  void reset(std::span<const bool> mask, std::uint64_t seed, std::span<const Parameters> parameters = {});
  void reset(std::uint64_t seed) { reset({}, seed); }

  /// The axes that have a motor, at the start or by an event; the same in all worlds.
  std::span<const Motor> motors() const;
  /// [num_local_worlds][num_motors] velocities [rad/s or m/s] at which the motors aim from the next step on,
  /// until the next call, a reset of the world, or an event of the scene for this motor. NaN leaves a motor
  /// as it is.
  void set_motor_velocities(std::span<const double> velocities);
  /// [num_local_worlds][num_motors] positions [rad or m], as BatchJoints has them, to which motors with a
  /// hold_rate bring their axes, as position servos of MJCF are: from the next step on the motor aims at
  /// hold_rate x (target - position), with at most its force. Lasts as a velocity does, which it replaces.
  /// NaN leaves a motor as it is. Throws for another number where a motor has no hold_rate then.
  void set_targets(std::span<const double> positions);

  /// The axes of all joints; the same in all worlds. Ball and fixed joints have none.
  std::span<const JointAxis> joint_axes() const;
  /// Joints as they are now, computed from state() once after a step; broken ones, too. The reference and its
  /// arrays' addresses stay valid until the batch ends.
  const BatchJoints& joints();
  /// Forces on centres of mass [N] and torques [N m], [num_local_worlds][num_bodies][3] each, world frame:
  /// they act from the next step on, throughout each step, until the next call or a reset of the world.
  /// Empty: none. With the stepper "sor" only.
  void set_forces(std::span<const double> forces, std::span<const double> torques = {});
  /// [num_local_worlds][num_joint_axes] torques [N m], or forces [N], between the bodies of each joint about
  /// or along its axis, likewise, besides its motor; the axes turn with their bodies from step to step.
  /// Broken joints have none. Empty: none.
  void set_efforts(std::span<const double> efforts);

  /// The names of a world's observables, e.g. "energy", "contacts", "joint_gap" (io/SCHEMA.md,
  /// /observables/world).
  std::vector<std::string> observable_names() const;
  /// [num_local_worlds], or [num_local_worlds][3] for a vector: values after the last step. What only a step
  /// knows (contacts, rows, ...) is 0 for a world that has not stepped since it was begun, set or loaded.
  std::vector<double> observable(std::string_view name) const;

  /// Everything that this rank's worlds need to go on, bit for bit, in a batch of the same scene and settings
  /// with as many worlds on this rank.
  std::vector<std::byte> save() const;
  /// Throws std::invalid_argument, changing nothing, for bytes that save() has not written or another batch
  /// wrote.
  void load(std::span<const std::byte> saved);

  /// Hash of all bits of a world of this rank, one of world_ids(), as pbmpi computes it.
  std::uint64_t hash(int world) const;
  /// Collective. Hash of all worlds: what pbmpi prints as state_hash.
  std::uint64_t hash() const;

 private:
  struct Worlds;
  std::unique_ptr<Worlds> worlds_;
};

/// The version of the library, e.g. "0.1.0".
PBMPI_EXPORT std::string version();

}  // namespace pbmpi
