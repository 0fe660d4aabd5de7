/// Speculative contacts and approaches in a world cut into spaces, as one rank finds them.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "effects/fast_bodies.h"
#include "geometry/box.h"
#include "model/space_map.h"

namespace pbmpi::solver {

/// Finds those of own bodies among each other and with static geoms; and, on root, those of bodies across
/// owners.
class SpaceFastBodies {
 public:
  /// `model` and `map` are borrowed.
  /// `most_approach_m`: see FastBodies.
  SpaceFastBodies(const model::Model& model, const model::SpaceMap& map, double dt_s, double most_approach_m);

  /// Makes these bodies this rank's own from now on.
  void own(std::span<const int> bodies) { own_.choose(bodies); }
  /// Takes in which joints are broken from now on (State::broken_in).
  void set_broken(std::span<const std::int32_t> broken_in) {
    own_.set_broken(broken_in);
    others_.set_broken(broken_in);
  }
  /// Returns how many own bodies are fast.
  int add_own(const model::State& state, std::vector<model::Contact>& contacts);
  /// Widens the boxes [num_spaces] of the spaces of these bodies by where fast ones may get in a step: bodies
  /// of spaces whose boxes are apart have nothing to be added across.
  void widen(const model::State& state, std::span<const int> bodies, std::span<geometry::Box> boxes);
  /// Looks at these bodies alone; `owner` [num_spaces].
  void add_across(const model::State& state, std::span<const int> bodies, std::span<const int> owner,
                  std::vector<model::Contact>& contacts);

 private:
  const model::SpaceMap* map_;
  double dt_s_;
  effects::FastBodies own_, others_;
  std::vector<int> owner_of_body_;  ///< [num_bodies] of those last looked at
};

}  // namespace pbmpi::solver
