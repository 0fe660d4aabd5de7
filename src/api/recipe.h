/// What the worlds of a batch are built from: the same on all ranks.
#pragma once

#include <cstdint>
#include <memory>
#include <string>

#include "mpi/comm/communicator.h"
#include "pbmpi/batch.h"
#include "scenes/scene.h"
#include "stepping/step_choices.h"

namespace pbmpi::api {

/// What one world is built from, in addition to its number.
struct WorldSeed {
  std::uint64_t seed = 1;
  Parameters parameters;

  bool operator==(const WorldSeed&) const = default;
};

/// Scene and settings. Immutable.
class Recipe {
 public:
  /// Collective. Throws core::InputError on every rank for what pbmpi refuses on its command line, and where
  /// the ranks were given different options.
  Recipe(const mpi::Communicator& comm, const BatchOptions& options);

  int num_worlds() const { return num_worlds_; }
  int steps_per_frame() const { return scene_->defaults().steps_per_frame; }
  const std::string& scene_name() const { return source_.name; }
  /// Settings of a world with this seed; its solver also draws from the seed, unless a solver seed was
  /// chosen.
  stepping::StepperSettings settings(std::uint64_t seed) const;

  /// The seed from which the solver of a world with this seed draws; one seed for all worlds where it draws
  /// nothing, so that they may share lanes.
  std::uint64_t solver_seed(std::uint64_t seed) const;

  /// Throws core::InputError.
  std::shared_ptr<const model::Model> build(int world, const WorldSeed& from) const;
  /// May worlds without parameters share a model, whatever their numbers and seeds?
  bool is_uniform() const { return scene_->is_uniform(); }

  /// Checksums of everything that decides the bits of a world, except its number, seed, parameters and step:
  /// one of the scene with its bases and effects, one of the settings.
  std::uint64_t scene_checksum() const;
  std::uint64_t settings_checksum() const;

 private:
  scenes::SceneSource source_;
  stepping::StepChoices choices_;
  std::unique_ptr<scenes::Scene> scene_;
  int num_worlds_ = 0;
};

}  // namespace pbmpi::api
