/// Poses of whole worlds, and one number per world, as arrays of numbers that are sent to root; no
/// communication.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "core/vector.h"
#include "stepping/frame.h"

namespace pbmpi::mpi {

/// Numbers that are sent for a world: its own number, positions [n][3], orientations [n][4] (w, x, y, z).
constexpr std::int64_t numbers_of_world(std::int64_t num_bodies) { return 1 + 7 * num_bodies; }

/// [num_ranks] bytes that each rank sends; root sends none.
std::vector<std::int64_t> share_bytes(const stepping::WorldTable& table, std::span<const int> placement,
                                      int num_ranks);

/// Writes the share of a rank with these worlds, by ascending id; `number` [worlds.size()].
void pack_share(std::span<const stepping::LocalWorld> worlds, std::span<const double> number, double* to);

/// Poses and numbers of all worlds on root.
struct GatheredPoses {
  std::vector<core::Vec3> position;     ///< [num_bodies] m, (world, body) order
  std::vector<core::Quat> orientation;  ///< [num_bodies] (w, x, y, z)
  std::vector<double> number;           ///< [num_worlds]

  void resize(const stepping::WorldTable& table);
  /// Copies root's own worlds.
  void copy(const stepping::WorldTable& table, std::span<const stepping::LocalWorld> worlds,
            std::span<const double> numbers);
  /// Unpacks the worlds of the other ranks. `received`: their shares by rank; `next` [num_ranks] where each
  /// begins.
  void unpack(const stepping::WorldTable& table, std::span<const int> placement,
              std::span<const double> received, std::vector<std::size_t> next);
};

}  // namespace pbmpi::mpi
