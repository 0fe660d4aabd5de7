/// The bytes of worlds that are saved.
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
  std::string version;  ///< of pbmpi: another may step to other bits
  std::string scene;    ///< its name
  std::uint64_t scene_checksum = 0, settings_checksum = 0;
};

/// One world at a step boundary.
struct SavedWorld {
  int id = 0;
  std::int64_t step = 0;
  WorldSeed from;
  std::vector<double> aims;  ///< [num_motors] velocities at which motors aim; NaN: as the scene has it
  model::State state;
};

/// All bits, behind a header and before a checksum; the numbers are this machine's.
std::vector<std::byte> write_worlds(const SavedFrom& from, std::span<const SavedWorld> worlds);

/// Inverse of write_worlds(). Throws core::InputError for what it did not write, for what has changed since,
/// and where `expected` differs; which ids, lengths and states fit is for the caller to find.
std::vector<SavedWorld> read_worlds(std::span<const std::byte> saved, const SavedFrom& expected);

}  // namespace pbmpi::api
