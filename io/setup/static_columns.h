/// The columns that are written once: bodies, geoms, joints, worlds and ranks.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <string_view>

#include "io/setup/column_writer.h"
#include "io/setup/run_setup.h"

namespace pbmpi::io {

/// Makes, or fills, /particles/bodies (without the moving part), /geoms, /hulls, /pair_materials, /joints,
/// /connectivity, /worlds, /world_parameters and /ranks. Collective; throws the same core::RunError on every
/// rank.
void write_static_columns(const FileRanks& ranks, ColumnFile file, const RunSetup& setup);

/// Bytes of the static columns, with names of usual length.
std::int64_t estimate_static_bytes(const RunShape& shape);

/// Parts of write_static_columns(), in its order.
void write_bodies(const FileRanks& ranks, ColumnFile file, const RunSetup& setup);
void write_geoms(const FileRanks& ranks, ColumnFile file, const RunSetup& setup);
/// Writes /hulls and /geoms/hull, if any world has a hull.
void write_hulls(const FileRanks& ranks, ColumnFile file, const RunSetup& setup);
void write_pair_materials(const FileRanks& ranks, ColumnFile file, const RunSetup& setup);
void write_joints(const FileRanks& ranks, ColumnFile file, const RunSetup& setup);
/// Writes /connectivity/joints in the form of H5MD: the joints between two bodies.
void write_connectivity(const FileRanks& ranks, ColumnFile file, const RunSetup& setup);
void write_worlds(const FileRanks& ranks, ColumnFile file, const RunSetup& setup);
/// Writes /world_parameters, if worlds have some.
void write_world_parameters(const FileRanks& ranks, ColumnFile file, const RunSetup& setup);

/// [num_worlds + 1] where the items of each world begin; `count` gives their number from its model.
/// Collective.
std::vector<std::int64_t> offsets(const FileRanks& ranks, const RunSetup& setup,
                                  const std::function<std::size_t(const model::Model&)>& count);

/// This rank's rows of a table in (world, item) order; `count` gives the number of items from a world's
/// model. Collective.
OwnRows rows_in_world_order(const FileRanks& ranks, const RunSetup& setup,
                            const std::function<std::size_t(const model::Model&)>& count);

/// Bytes of the longest of these names.
template <std::size_t N>
constexpr std::size_t longest(const std::array<std::string_view, N>& names) {
  std::size_t length = 1;
  for (const std::string_view name : names) length = name.size() > length ? name.size() : length;
  return length;
}

}  // namespace pbmpi::io
