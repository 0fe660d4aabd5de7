/// The worlds behind a recorded run, built anew from the scene's text that its file carries.
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "analysis/pose_errors.h"
#include "io/run/run_data.h"
#include "scenes/scene.h"

namespace pbmpi::app {

struct RunModels {
  std::vector<std::shared_ptr<const model::Model>> worlds;
  std::vector<std::size_t> first_body;   ///< [num_worlds] in the file's order
  std::vector<std::size_t> first_joint;  ///< [num_worlds] in the file's order
};

/// Worlds of `scene` as the run had them: with their numbers in the ensemble, and their parameters. Throws
/// core::InputError.
std::vector<std::shared_ptr<const model::Model>> build_worlds(const scenes::Scene& scene,
                                                              const io::RunData& run, std::uint64_t seed);

/// Throws core::InputError if the text cannot be read, or gives other bodies than the file has.
RunModels rebuild_models(const io::RunData& run, const std::string& path);

/// Poses [N] of all bodies of one recorded frame.
struct RecordedPoses {
  const std::vector<core::Vec3>* position = nullptr;
  const std::vector<core::Quat>* orientation = nullptr;
  std::vector<std::int32_t> broken_in = {};  ///< [J] as in model::State; empty: all joints hold

  /// The poses of one world.
  analysis::PoseView world(const RunModels& models, std::size_t world) const;
};

/// [J] joints that are broken in a recorded row, from the file's column or its events; empty if none is known
/// to be broken.
std::vector<std::int32_t> broken_at(const RunModels& models, const io::RunData& run, std::size_t row);

/// [J] the first body of each joint, over all worlds.
std::vector<std::size_t> bodies_of_joints(const RunModels& models);

/// Compares every body and joint of every world, in order; joints by their rows in the file.
analysis::PoseErrors compare_recorded(const RunModels& models, const RecordedPoses& poses,
                                      const RecordedPoses& reference);

/// Stretch of every human segment of every world.
std::vector<double> recorded_stretch(const RunModels& models, const RecordedPoses& poses);

/// Rows of the recorded frames that are measured (not warm-up), below `num_rows`.
std::vector<std::size_t> measured_rows(const io::RunData& run, std::size_t num_rows);

/// Throws core::InputError unless both runs have the same bodies in the same order, with the same mass and
/// the same start, and recorded them at the same times (as far as both runs reach).
void require_comparable(const io::RunData& a, const std::string& path_a, const io::RunData& b,
                        const std::string& path_b);

}  // namespace pbmpi::app
