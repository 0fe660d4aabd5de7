/// The narrow phase: contact points of pairs of geoms, and their contact joints.
#pragma once

#include <deque>
#include <memory>
#include <vector>

#include "effects/effects.h"
#include "geometry/hulls/surface_contacts.h"
#include "geometry/seams.h"
#include "model/contact.h"
#include "model/step_memory.h"
#include "ode/collide/broad_phase.h"
#include "stepping/engine/touch.h"

namespace pbmpi::ode {

/// Converts what dCollide found for a pair into a contact: body a is a real one, and the normal points into
/// it.
model::Contact to_contact(const model::Model& model, const GeomPair& pair, const dContactGeom& found);

/// Makes the contact joints of a step. Handles friction, restitution and the counting of contacts across
/// spaces only if the plan has them.
class Contacts {
 public:
  /// `model` is borrowed.
  Contacts(const model::Model& model, const effects::StepPlan& plan, const std::vector<dBodyID>& bodies);

  /// Collides each pair (dCollide with the lower geom first, or SurfaceContacts) and joins touching geoms, in
  /// the order of `pairs`.
  void make(dWorldID world, const std::vector<GeomPair>& pairs, const std::vector<dGeomID>& geoms);
  /// Adds joints for the speculative contacts of fast bodies (effects::FastBodies): gaps that may close in a
  /// step of `dt_s`.
  void make_ahead(dWorldID world, const std::vector<model::Contact>& contacts, double dt_s);
  /// Removes the contact joints. touches() and deepest_m() stay until the next make().
  void clear() { dJointGroupEmpty(joints_.get()); }

  /// Sets whether contacts and their forces are kept for show(), from the next make() on.
  void keep(bool keep) { keeps_ = keep; }
  /// Appends the kept contacts, with their forces in the step that was solved since then. `before`: the
  /// centres of the bodies before that step [m].
  void show(std::span<const model::Vec3> before, std::vector<model::LoadedContact>& shown) const;

  /// Forgets touches() as well: the step has no contacts.
  void forget() {
    kept_.clear();
    touches_.clear();
    deepest_m_ = 0;
  }

  const std::vector<stepping::Touch>& touches() const { return touches_; }
  double deepest_m() const { return deepest_m_; }  ///< 0 without contacts

 private:
  dBodyID body_id(int body) const { return body == model::no_body ? nullptr : bodies_[body]; }
  /// Fills found_; returns how many.
  int collide(const GeomPair& pair, const std::vector<dGeomID>& geoms);
  int collide_surfaces(const GeomPair& pair);
  model::BodyPose pose_of(int body) const;
  int correct_at_seams(const GeomPair& pair, int num_contacts);
  void join(dWorldID world, const GeomPair& pair, int num_contacts);
  int set_surface(const GeomPair& pair);
  void watch(dJointID joint, const model::Contact& contact);
  bool is_cross_space(const GeomPair& pair) const;

  const model::Model* model_;
  std::vector<dBodyID> bodies_;
  bool friction_;
  bool restitution_;
  bool cross_space_;
  JointGroupHandle joints_;
  dContact contact_{};               ///< the contact that is being filled
  int most_per_pair_;                ///< of dCollide
  std::vector<dContactGeom> found_;  ///< at least [most_per_pair_]
  geometry::SurfaceContacts surfaces_;
  std::unique_ptr<const geometry::Seams> seams_;  ///< none where no geoms touch that keep together
  std::vector<model::Contact> corrected_;         ///< scratch of correct_at_seams()
  struct Kept {
    model::Contact contact;
    dJointFeedback feedback;
  };
  bool keeps_ = false;
  std::deque<Kept> kept_;  ///< ODE writes into these while it solves
  std::vector<stepping::Touch> touches_;
  double deepest_m_ = 0;
};

}  // namespace pbmpi::ode
