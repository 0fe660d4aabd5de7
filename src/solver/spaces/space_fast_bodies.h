/// Speculative contacts and approaches in a world cut into spaces, as one rank finds them.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "effects/fast_bodies.h"
#include "model/space_map.h"

namespace pbmpi::solver {

/// Finds those of own bodies among each other and with static geoms; and, on root, those of all bodies across
/// owners.
class SpaceFastBodies {
 public:
  /// `model` and `map` are borrowed.
  /// `most_approach_m`: see FastBodies.
  SpaceFastBodies(const model::Model& model, const model::SpaceMap& map, double dt_s, double most_approach_m);

  /// Makes these bodies [num_bodies] this rank's own from now on.
  void own(std::span<const char> is_own) { own_.emplace(*model_, is_own, most_approach_m_); }
  /// Takes in which joints are broken from now on (State::broken_in); after own().
  void set_broken(std::span<const std::int32_t> broken_in) {
    own_->set_broken(broken_in);
    all_.set_broken(broken_in);
  }
  /// Finds the own bodies that are fast or may approach others, ascending.
  std::vector<int> find_own(const model::State& state);
  /// Returns how many own bodies are fast.
  int add_own(const model::State& state, std::vector<model::Contact>& contacts);
  /// `owner` [num_spaces]
  void add_across(const model::State& state, std::span<const int> owner,
                  std::vector<model::Contact>& contacts);

 private:
  const model::Model* model_;
  const model::SpaceMap* map_;
  double dt_s_, most_approach_m_;
  std::optional<effects::FastBodies> own_;
  effects::FastBodies all_;
  std::vector<int> owner_of_body_;  ///< scratch
};

}  // namespace pbmpi::solver
