/// Cells of a world: articulations that lie near each other at the start.
#pragma once

#include <span>
#include <vector>

#include "model/model.h"
#include "solver/layout/articulation.h"

namespace pbmpi::solver {

/// How many bodies, with numbers of so many bytes, have velocities and rows that stay in a core's L2 cache,
/// where a sweep reads them again and again (measured on 100CrSk: 500 to 2,000 bodies in float are equally
/// fast, twice as many cost a tenth more; in double half as many).
constexpr int bodies_in_cache(int bytes_a_number) { return 7200 / bytes_a_number; }

/// The cell of each articulation. A cell has at most `most_bodies`, or one articulation. What is larger is
/// cut across its longest side, where there is a wide gap between its articulations near the middle.
std::vector<int> find_cells(const model::Model& model, std::span<const Articulation> articulations,
                            int most_bodies);

}  // namespace pbmpi::solver
