/// Owners of spaces before anything is measured: pure data, the same on every rank.
#pragma once

#include <span>
#include <vector>

#include "core/vector.h"
#include "model/model.h"
#include "model/space_map.h"

namespace pbmpi::mpi {

/// [num_spaces] the rank that owns each, by recursive bisection (Berger and Bokhari, "A partitioning strategy
/// for nonuniform problems on multiprocessors", IEEE Trans. Comput. 36, 1987): a plane across the longest
/// side of the centres parts the ranks into halves and the costs with them, so that neighbours share a rank
/// and few islands cross. Where no plane leaves every rank within a tenth of the mean, the ranks of that part
/// share its spaces by longest processing time first, wherever these are.
///
/// `cost`: [num_spaces] as space_costs(); `centre`: [num_spaces] in m, world frame. Deterministic.
std::vector<int> owners_by_place(std::span<const double> cost, std::span<const core::Vec3> centre,
                                 int num_ranks);

/// The same from where the bodies of each space are at the start.
std::vector<int> initial_owners(const model::Model& model, const model::SpaceMap& map, int num_ranks);

}  // namespace pbmpi::mpi
