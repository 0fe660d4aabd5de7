/// Counts of the islands that one rank has solved.
#pragma once

#include <functional>
#include <optional>
#include <span>

#include "effects/space_sleepers.h"
#include "model/contact.h"
#include "model/space_map.h"
#include "solver/layout/articulation.h"
#include "stepping/space_stepper.h"

namespace pbmpi::solver {

/// Counts islands of `units` (ascending) and all contacts that touch them. A unit whose joints have broken
/// falls into several islands. `articulations`: one for each unit. `joint_rows`: the rows of a joint in the
/// last step, or nothing if it has broken; `sweeps`: the sweeps of a body's rows in it. `sleepers` may be
/// null; sleeping islands are counted too.
stepping::Observables count_islands(const model::Model& model, const model::SpaceMap& map,
                                    std::span<const Articulation> articulations, std::span<const int> units,
                                    std::span<const model::Contact> contacts,
                                    const std::function<std::optional<int>(int joint)>& joint_rows,
                                    const std::function<int(int body)>& sweeps,
                                    const effects::SpaceSleepers* sleepers);

}  // namespace pbmpi::solver
