/// The narrow phase: contact points of pairs of geoms.
#pragma once

#include <span>
#include <vector>

#include "bullet/collide/collider.h"
#include "bullet/objects/shapes.h"
#include "effects/effects.h"
#include "model/contact.h"
#include "model/step_memory.h"
#include "stepping/engine/touch.h"

namespace pbmpi::bullet {

/// Makes the contacts of a step with Bullet's algorithms, one manifold per pair, all of them anew: the points
/// of earlier steps, with which Bullet completes its manifolds and warm-starts its solver, are not part of a
/// state. Handles friction and restitution only if the plan has them.
class Contacts {
 public:
  /// All are borrowed.
  Contacts(const model::Model& model, const effects::StepPlan& plan, const Shapes& shapes, Bodies& bodies,
           Collider& collider, const btDispatcherInfo& info, double dt_s);
  ~Contacts() { clear(); }
  Contacts(const Contacts&) = delete;
  Contacts& operator=(const Contacts&) = delete;

  /// Collides each pair, in the order of `pairs`.
  void make(const std::vector<model::GeomPair>& pairs);
  /// Adds the speculative contacts of fast bodies (effects::FastBodies): gaps that may close in a step.
  void make_ahead(const std::vector<model::Contact>& contacts);
  /// Removes the contacts from the dispatcher. touches() and deepest_m() stay until the next make().
  void clear();
  /// Forgets touches() as well: the step has no contacts.
  void forget();

  /// Appends the contacts and their forces in the step that was solved since make(). `before`: the centres of
  /// the bodies before that step [m].
  void show(std::span<const model::Vec3> before, std::vector<model::LoadedContact>& shown) const;

  const std::vector<stepping::Touch>& touches() const { return touches_; }
  double deepest_m() const { return deepest_m_; }  ///< 0 without contacts

 private:
  struct Made {
    btPersistentManifold* manifold;
    model::GeomPair geoms;
    model::Material material;  ///< of the pair
  };
  void collide(const model::GeomPair& pair);
  void run(int a, int b, btPersistentManifold& manifold);
  void keep(btPersistentManifold& manifold, const stepping::Touch& touch, const model::GeomPair& geoms,
            const model::Material& material);
  void set_bounce(const btPersistentManifold& manifold, double restitution, btManifoldPoint& point) const;
  model::Material surface_of(const model::GeomPair& pair) const;

  const model::Model* model_;
  const Shapes* shapes_;
  Bodies* bodies_;
  Collider* collider_;
  const btDispatcherInfo* info_;
  double dt_s_;
  bool friction_;
  bool restitution_;
  int most_points_;  ///< per pair
  std::vector<Made> made_;
  std::vector<stepping::Touch> touches_;
  double deepest_m_ = 0;
};

}  // namespace pbmpi::bullet
