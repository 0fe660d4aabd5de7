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

/// From what one world is built, beside its number.
struct WorldSeed {
  std::uint64_t seed = 1;
  Parameters parameters;

  bool operator==(const WorldSeed&) const = default;
};

/// Scene and settings. Immutable.
class Recipe {
 public:
  /// Collective. Throws core::InputError on every rank: for what pbmpi refuses on its command line, and where
  /// the ranks were given different options.
  Recipe(const mpi::Communicator& comm, const BatchOptions& options);

  int num_worlds() const { return num_worlds_; }
  int steps_per_frame() const { return scene_->defaults().steps_per_frame; }
  const std::string& scene_name() const { return source_.name; }
  /// Of a world with this seed: the solver draws from it, too, unless its own was chosen.
  stepping::StepperSettings settings(std::uint64_t seed) const;

  /// From what the solver of a world with this seed draws: from the same for all where it draws nothing, so
  /// that they may share lanes.
  std::uint64_t solver_seed(std::uint64_t seed) const;

  /// Throws core::InputError.
  std::shared_ptr<const model::Model> build(int world, const WorldSeed& from) const;
  /// May worlds without parameters share a model, whatever their numbers and seeds?
  bool is_uniform() const { return scene_->is_uniform(); }

  /// All that decides the bits of a world beside its number, seed, parameters and step: scene with its bases,
  /// effects, and settings, a checksum each.
  std::uint64_t scene_checksum() const;
  std::uint64_t settings_checksum() const;

 private:
  scenes::SceneSource source_;
  stepping::StepChoices choices_;
  std::unique_ptr<scenes::Scene> scene_;
  int num_worlds_ = 0;
};

}  // namespace pbmpi::api
