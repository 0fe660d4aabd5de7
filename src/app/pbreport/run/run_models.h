/// The worlds behind a recorded run, built anew from the scene's text that its file carries.
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "io/run/run_data.h"
#include "model/model.h"
#include "scenes/scene.h"

namespace pbmpi::app {

/// Worlds of `scene` as the run had them: with their numbers in the ensemble, and their parameters. Throws
/// core::InputError.
std::vector<std::shared_ptr<const model::Model>> build_worlds(const scenes::Scene& scene,
                                                              const io::RunData& run, std::uint64_t seed);

}  // namespace pbmpi::app
