/// Contacts, and the interface through which geoms are tested against each other, whatever the engine.
#pragma once

#include <algorithm>
#include <cmath>
#include <compare>
#include <functional>
#include <memory>
#include <span>
#include <vector>

#include "model/model.h"

namespace pbmpi::model {

/// Pose of a body or geom as collision detection wants it, world frame.
struct BodyPose {
  double position[3];  ///< [m]
  double rotation[9];  ///< matrix, by rows
};

/// Two geoms by their indices in the model, first < second. Sorts by (first, second).
struct GeomPair {
  int first = 0;
  int second = 0;
  auto operator<=>(const GeomPair&) const = default;
};

/// One contact point. Body a is never the environment; the normal points into it.
struct Contact {
  int body_a = 0;
  int body_b = no_body;  ///< no_body: a is in contact with the static environment
  Vec3 position;     ///< [m] world frame; half way between the surfaces (ODE's collider: on one or the other)
  Vec3 normal;       ///< unit, world frame
  double depth = 0;  ///< [m]; below 0: a gap that may close in this step (effects/fast_bodies.h)
  double mu = 0;
  double restitution = 0;
  /// [m] Above 0: an approach, that is no point of contact, but two bodies that come nearer by so much in
  /// this step and may begin to touch within it (effects/fast_bodies.h). It tells neither place nor depth.
  double approach = 0;
  GeomPair geoms;  ///< the two that touch; canonical order of contacts is sorted by them

  bool is_approach() const { return approach > 0; }
};

/// The material of a touching pair without a PairMaterial, by the rule stated at Material.
inline Material combined(const Material& a, const Material& b) {
  return {std::sqrt(a.mu * b.mu), std::max(a.restitution, b.restitution)};
}

/// The entry of Model::pair_materials for the actors of two geoms; null if there is none.
const Material* find_pair_material(const Model& model, const GeomPair& pair);

/// The material of a touching pair whose geoms have the materials `first` and `second`.
inline Material pair_material(const Model& model, const GeomPair& pair, const Material& first,
                              const Material& second) {
  if (!model.pair_materials.empty()) {
    if (const Material* given = find_pair_material(model, pair)) return *given;
  }
  return combined(first, second);
}

/// Number of rows of a contact with this friction coefficient: a normal row, and two friction rows if mu > 0.
constexpr int contact_rows(double mu) { return mu > 0 ? 3 : 1; }

/// Contact points of pairs of geoms.
class NarrowPhase {
 public:
  virtual ~NarrowPhase() = default;
  /// Appends the contacts of `pairs`, pair by pair. `poses`: [num_bodies].
  virtual void collide(std::span<const BodyPose> poses, std::span<const GeomPair> pairs,
                       std::vector<Contact>& contacts) = 0;
};

/// Makes the narrow phase of one world; the model must outlive it.
using MakeNarrowPhase = std::function<std::unique_ptr<NarrowPhase>(const Model& model)>;

}  // namespace pbmpi::model
