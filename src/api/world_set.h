/// The worlds of a batch that this rank owns.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "api/recipe.h"
#include "api/saved_worlds.h"
#include "api/seeded_steppers.h"
#include "api/world_layout.h"
#include "mpi/comm/communicator.h"
#include "pbmpi/batch.h"
#include "stepping/observables.h"

namespace pbmpi::api {

/// Does what Batch documents for its calls; errors are core::InputError and core::RunError.
class WorldSet {
 public:
  explicit WorldSet(const BatchOptions& options);

  const Recipe& recipe() const { return recipe_; }
  const WorldLayout& layout() const { return layout_; }
  double dt_s() const { return recipe_.settings(0).dt_s; }
  std::span<const int> ids() const { return ids_; }
  std::span<const std::int64_t> steps() const { return steps_; }

  void step(int num_steps);
  const BatchState& state();
  void set_state(const BatchState& state, std::span<const bool> mask);
  void reset(std::span<const bool> mask, std::uint64_t seed, std::span<const Parameters> parameters);
  void set_motor_velocities(std::span<const double> velocities);
  void set_targets(std::span<const double> positions);
  const BatchJoints& joints();
  void set_forces(std::span<const double> forces, std::span<const double> torques);
  void set_efforts(std::span<const double> efforts);
  static std::vector<std::string> observable_names();
  std::vector<double> observable(std::string_view name) const;
  std::vector<std::byte> save() const;
  void load(std::span<const std::byte> saved);
  std::uint64_t hash(int world) const;
  std::uint64_t hash() const;

 private:
  /// Velocities at which the motors of a world were told to aim.
  struct Aims {
    std::vector<double> velocity;     ///< [num_motors]; NaN: the scene's own
    std::vector<std::int64_t> since;  ///< [num_motors] the step before which each aim was set
  };
  struct World {
    WorldSeed from;
    std::shared_ptr<const model::Model> model;
    Aims aims;
    bool measured = false;                       ///< has it stepped since its state was last set?
    std::vector<stepping::BodyLoad> loads = {};  ///< [num_bodies] set from outside; empty: none
    std::vector<double> efforts = {};            ///< [num_joint_axes]; empty: none
    std::shared_ptr<const analysis::JointCoordinates> coordinates =
        nullptr;  ///< null until they are asked for
  };

  std::size_t num_worlds() const { return ids_.size(); }
  SeededSteppers make_steppers() const;
  /// Builds world `id` from `from`; throws unless it is like the others.
  World build(int id, WorldSeed from) const;
  std::uint64_t solver_seed(const WorldSeed& from) const { return recipe_.solver_seed(from.seed); }
  const model::State& state_of(std::size_t index) const {
    return steppers_.of(ids_[index]).state(ids_[index]);
  }
  stepping::Observables observables_of(std::size_t index) const;
  Aims no_aims() const;
  /// The velocity that a motor still aims at: an event may have ended it.
  double aim_now(std::size_t index, std::size_t motor) const;
  void aim(std::size_t index, std::size_t motor, double velocity);
  /// Aims all motors whose value is not NaN: [num_worlds][num_motors]. `what`: "velocities".
  void aim_all(std::span<const double> velocities, const std::string& what);
  /// The rate at which a motor returns to its target in the next step; throws if it holds no pose.
  double hold_rate(std::size_t index, std::size_t motor) const;
  void require_loads() const;
  /// The loads of the world's bodies for the next step, with what the efforts of its joints come to.
  std::vector<stepping::BodyLoad> loads_now(std::size_t index) const;
  void push(std::size_t index);
  bool has_efforts() const;
  void make_old() { arrays_are_old_ = joints_are_old_ = true; }
  SavedFrom saved_from() const;
  /// Throws unless `saved` fits the world of this index, built as `world`.
  void require_fit(std::size_t index, const SavedWorld& saved, const World& world) const;

  mpi::Communicator comm_;
  Recipe recipe_;
  std::vector<int> ids_;
  Parameters first_parameters_;                      ///< world 0's
  std::shared_ptr<const model::Model> first_world_;  ///< world 0, which all others are like
  WorldLayout layout_;
  std::vector<World> worlds_;        ///< [num_worlds]
  std::vector<std::int64_t> steps_;  ///< [num_worlds]
  SeededSteppers steppers_;
  BatchState arrays_;
  bool arrays_are_old_ = true;
  BatchJoints joints_;
  bool joints_are_old_ = true;
};

}  // namespace pbmpi::api
