/// What a step hands on to the next in addition to poses and velocities.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "model/contact.h"

namespace pbmpi::model {

/// The force with which a contact point ended a step, and how the next step finds the point again: by its
/// pair of geoms, and among the points of a pair by its position.
struct ContactForce {
  GeomPair geoms;
  int body_a = 0, body_b = no_body;  ///< as in Contact
  Vec3 arm = Vec3::Zero();           ///< [m] from the centre of body a to the point, world axes
  double normal = 0;                 ///< [N]
  Vec3 friction = Vec3::Zero();      ///< [N] on body a, world frame

  /// No force yet, at a contact. `centre`: of body a [m], world frame.
  static ContactForce at(const Contact& contact, const Vec3& centre) {
    return {.geoms = contact.geoms,
            .body_a = contact.body_a,
            .body_b = contact.body_b,
            .arm = contact.position - centre};
  }
};

/// A contact, and the force with which it ended a step.
struct LoadedContact {
  Contact contact;
  ContactForce force;
};

/// The contacts of a world, in canonical order, and the forces with which they start and end a step:
/// [contacts], or none where nothing is remembered or shown. Borrowed.
struct SolvedContacts {
  std::span<const Contact> contacts;
  std::span<ContactForce> forces;

  SolvedContacts part(std::size_t first, std::size_t count) const {
    return {contacts.subspan(first, count),
            forces.empty() ? std::span<ContactForce>() : forces.subspan(first, count)};
  }
};

/// The forces with which a joint ended a step, on its first body, world frame; and what its pose does not
/// tell of its place.
struct JointForce {
  Vec3 force = Vec3::Zero();   ///< [N] exerted by the rows along lines
  Vec3 torque = Vec3::Zero();  ///< [N m] exerted by the rows about axes
  double control[2] = {};      ///< [N] or [N m] of the limits and motors of the joint's axes
  double rotor[2] = {};        ///< [N] or [N m] by which the armatures of the axes resist
  double angle[2] = {};        ///< [rad] about the axes since the start, where limits need turns counted
};

/// Forces from which the next step's solver starts. They are forces, not impulses, so that they stay valid
/// for a step of another length. Empty where the stepper remembers nothing.
struct StepMemory {
  std::vector<ContactForce> contacts;  ///< in canonical order
  std::vector<JointForce> joints;      ///< [num_joints] or none

  bool empty() const { return contacts.empty() && joints.empty(); }
  void clear() {
    contacts.clear();
    joints.clear();
  }
};

}  // namespace pbmpi::model
