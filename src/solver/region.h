/// The own spaces of a rank, swept together.
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "model/space_map.h"
#include "solver/broad_phase.h"

namespace pbmpi::solver {

/// The geoms of some spaces and the static ones as a model of their own; its bodies are those of the whole
/// model.
class Region {
 public:
  /// `is_own`: [num_spaces].
  Region(const model::Model& whole, const model::SpaceMap& map, const std::vector<char>& is_own);
  Region(const Region&) = delete;
  Region& operator=(const Region&) = delete;

  /// As BroadPhase::find_pairs(), by the geoms of the whole model.
  void find_pairs(std::span<const model::BodyPose> poses, std::vector<model::GeomPair>& pairs);

 private:
  model::Model model_;
  std::vector<int> geoms_;  ///< [geoms of model_] ascending: which of the whole model
  std::optional<BroadPhase> broad_phase_;
};

}  // namespace pbmpi::solver
