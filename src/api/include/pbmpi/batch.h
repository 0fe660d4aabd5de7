/// Many worlds of one scene, stepped together: pbmpi without its programs.
///
/// This header and what it includes is all of the library that is meant to stay as it is. SI units, world
/// frame, z up; orientations are (w, x, y, z). Bad input throws std::invalid_argument with a message that
/// says what, where and what to do; a run that fails throws std::runtime_error.
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

/// What is changed in the scene for one world: "ACTOR.KEY", "JOINT.KEY" or "world.KEY", as a scene file has
/// them, and the value as TOML, e.g. {"car.speed", "12.5"}, {"world.gravity", "[0, 0, -1.62]"}.
using Parameters = std::map<std::string, std::string>;

/// What a batch is made of.
struct BatchOptions {
  /// A scene that pbmpi brings ("CrashSk", `pbmpi --list-scenes`), or the path of a file: .toml
  /// (scenes/FORMAT.md), .xml (MJCF) or .urdf.
  std::string scene;
  /// The text of a scene file, instead of one that is read; `scene` then only names it.
  std::string scene_text;
  int num_worlds = 0;  ///< of all ranks together; 0: as many as the scene says
  std::uint64_t seed = 1;
  /// Options of a step as pbmpi's command line has them, without dashes: {"stepper", "sor"}, {"precision",
  /// "single"}, {"dt", "0.005"}, {"threads", "4"}, {"effects", "+sleeping,-friction"}. What is not named is
  /// as pbmpi has it by default.
  std::map<std::string, std::string> settings;
  /// [num_worlds], or none: what each world has otherwise than the scene.
  std::vector<Parameters> parameters;
  /// MPI_Comm_c2f() of the communicator over whose ranks the worlds are dealt out in blocks; MPI is
  /// initialised by the caller. Without one the batch calls no MPI.
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

/// An axis that a motor drives.
struct Motor {
  std::string name;      ///< the joint's, with "/2" behind it for a second axis
  double max_force = 0;  ///< [N m], of a slider [N]: at the start
};

/// The worlds that this rank owns, of all that the batch has. Calls marked "collective" are made by all ranks
/// of the communicator in the same order. The bits of a world depend on scene, seed, parameters, settings and
/// step alone: not on the other worlds, on the number of ranks or of threads, nor on when it was reset.
class PBMPI_EXPORT Batch {
 public:
  /// Collective.
  explicit Batch(const BatchOptions& options);
  ~Batch();
  Batch(Batch&&) noexcept;
  Batch& operator=(Batch&&) noexcept;

  int num_worlds() const;                  ///< of all ranks
  int num_local_worlds() const;            ///< of this rank
  std::span<const int> world_ids() const;  ///< [num_local_worlds], ascending
  int num_bodies() const;                  ///< of a world; all have the same bodies
  std::span<const std::string> body_names() const;
  double dt_s() const;
  int steps_per_frame() const;  ///< of the scene: 1/30 s
  /// [num_local_worlds] steps since each world's start.
  std::span<const std::int64_t> steps() const;

  /// Steps all worlds. No message between ranks.
  void step(int num_steps = 1);

  /// Poses and velocities as they are now; copied out of the steppers' lanes by this call, once after a step.
  /// The reference holds, and its arrays stay where they are, until the batch ends.
  const BatchState& state();
  /// Replaces them; forces that a step hands on to the next, and what rests, breaks or is remembered
  /// otherwise is kept, as in a world that somebody pushed: what sleeps wakes if a body of its island is
  /// elsewhere or moves otherwise than before. `mask`: [num_local_worlds], whose; empty: all.
  void set_state(const BatchState& state, std::span<const bool> mask = {});

  /// Worlds begin anew, at step 0: with `seed`, and with what each now has otherwise than the scene
  /// ([num_local_worlds]; empty: what it had). Those outside of `mask` go on. Bit for bit as a new batch. The
  /// solver draws from `seed`, too, unless the setting "solver-seed" is chosen. Only worlds of one solver
  /// seed and one step lie side by side in vector lanes, unless the setting "row-order" is "fixed": choose
  /// that where worlds begin anew one by one.
  void reset(std::span<const bool> mask, std::uint64_t seed, std::span<const Parameters> parameters = {});
  void reset(std::uint64_t seed) { reset({}, seed); }

  /// The axes that have a motor, at the start or by an event; the same in all worlds.
  std::span<const Motor> motors() const;
  /// [num_local_worlds][num_motors] velocities [rad/s or m/s] at which the motors aim from the next step on;
  /// NaN leaves a motor as it is. Until the next call, a reset of the world, or an event of the scene for
  /// this motor.
  void set_motor_velocities(std::span<const double> velocities);

  /// The names of what is measured of a world, e.g. "energy", "contacts", "joint_gap" (io/SCHEMA.md,
  /// /observables/world).
  std::vector<std::string> observable_names() const;
  /// [num_local_worlds], or [num_local_worlds][3] for a vector: after the last step. Of a world that has not
  /// stepped since it was begun, set or loaded, what the step alone knows (contacts, rows, ...) is 0.
  std::vector<double> observable(std::string_view name) const;

  /// All that this rank's worlds need to go on, bit for bit, in a batch of the same scene and settings, with
  /// as many worlds on this rank.
  std::vector<std::byte> save() const;
  /// Throws std::invalid_argument for what save() has not written, or another batch; nothing is then changed.
  void load(std::span<const std::byte> saved);

  /// Of all bits of a world of this rank, one of world_ids(): as pbmpi hashes it.
  std::uint64_t hash(int world) const;
  /// Collective. Of all worlds: what pbmpi prints as state_hash.
  std::uint64_t hash() const;

 private:
  struct Worlds;
  std::unique_ptr<Worlds> worlds_;
};

/// The version of the library, e.g. "0.1.0".
PBMPI_EXPORT std::string version();

}  // namespace pbmpi
