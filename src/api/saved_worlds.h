/// Saved worlds as bytes.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "api/recipe.h"
#include "model/state.h"

namespace pbmpi::api {

/// What a batch must have in common with the one that was saved.
struct SavedFrom {
  std::string version;  ///< pbmpi's; another version may step to other bits
  std::string scene;    ///< its name
  std::uint64_t scene_checksum = 0, settings_checksum = 0;
};

/// One world at a step boundary.
struct SavedWorld {
  int id = 0;
  std::int64_t step = 0;
  WorldSeed from;
  std::vector<double> aims;     ///< [num_motors] velocities at which motors aim; NaN: the scene's own
  std::vector<double> loads;    ///< [num_bodies][6] force [N] and torque [N m] from outside; empty: none
  std::vector<double> efforts;  ///< [num_joint_axes] [N m] or [N]; empty: none
  model::State state;
};

/// All bits, between a header and a checksum; numbers in this machine's representation.
std::vector<std::byte> write_worlds(const SavedFrom& from, std::span<const SavedWorld> worlds);

/// Inverse of write_worlds(). Throws core::InputError for bytes that it did not write, for bytes that have
/// changed since, and where `expected` differs; the caller checks which ids, lengths and states fit.
std::vector<SavedWorld> read_worlds(std::span<const std::byte> saved, const SavedFrom& expected);

}  // namespace pbmpi::api
