/// Finds the pairs of geoms that may touch, in an order that depends only on the pairs.
#pragma once

#include <cstdint>
#include <vector>

#include "model/contact.h"
#include "ode/objects/geoms.h"

namespace pbmpi::ode {

enum class SpaceKind { simple, sweep_and_prune };

/// The ODE space that is measured as fastest for this number of geoms (bench_worlds --spaces; ODE's hash
/// space never is).
SpaceKind best_space(std::size_t num_geoms);

using model::GeomPair;

class BroadPhase {
 public:
  BroadPhase(const model::Model& model, const std::vector<dBodyID>& bodies, SpaceKind kind);
  BroadPhase(const BroadPhase&) = delete;
  BroadPhase& operator=(const BroadPhase&) = delete;

  /// The pairs whose bounding boxes overlap and which may touch. They are sorted, which removes the space's
  /// own order with its dependence on history. Valid until the next call.
  const std::vector<GeomPair>& find_pairs();
  /// Takes in the joints that are broken from now on: State::broken_in.
  void set_broken(const model::Model& model, std::span<const std::int32_t> broken_in) {
    geoms_.set_broken(model, broken_in);
  }
  const std::vector<dGeomID>& geoms() const { return geoms_.ids(); }

 private:
  static void offer(void* self, dGeomID a, dGeomID b);

  SpaceHandle space_;
  Geoms geoms_;
  std::vector<GeomPair> pairs_;
};

}  // namespace pbmpi::ode
