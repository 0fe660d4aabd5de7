/// Finds the forces with which the contacts of a step start among those with which the last step ended.
#pragma once

#include <span>
#include <vector>

#include "model/contact.h"
#include "model/step_memory.h"

namespace pbmpi::solver {

/// Serves one world. A contact point takes over the forces of a point of the same pair of geoms: of the
/// nearest, seen from the centre of its first body, that no earlier point has taken.
class ContactRecall {
 public:
  /// Both in canonical order; centre(body): [m] world frame. keeps(old): is this force to be remembered
  /// although no contact of this step can take it over, because its bodies are not considered?
  template <class Centre, class Keeps>
  void recall(std::span<const model::Contact> contacts, std::span<const model::ContactForce> before,
              Centre centre, Keeps keeps) {
    forces_.clear();
    int body = model::no_body;  // whose centre is in `at`: contacts of a body are consecutive
    model::Vec3 at = model::Vec3::Zero();
    for (const model::Contact& contact : contacts) {
      if (contact.body_a != body) at = centre(body = contact.body_a);
      forces_.push_back(model::ContactForce::at(contact, at));
    }
    kept_.clear();
    for (const model::ContactForce& old : before) {
      if (keeps(old)) kept_.push_back(old);
    }
    match(before);
  }
  /// [contacts], to be replaced by the forces with which the step ends.
  std::span<model::ContactForce> forces() { return forces_; }
  /// The step has ended with other contacts, which had these forces.
  void replace(std::span<const model::ContactForce> forces) { forces_.assign(forces.begin(), forces.end()); }
  /// The contacts of recall() or replace(), given again, with their forces.
  std::vector<model::LoadedContact> loaded(std::span<const model::Contact> contacts) const;
  std::span<const model::ContactForce> forces() const { return forces_; }
  /// What is to be remembered after the step.
  void store(std::vector<model::ContactForce>& memory) const;

 private:
  void match(std::span<const model::ContactForce> before);

  std::vector<model::ContactForce> forces_, kept_;
  std::vector<char> taken_;  ///< which old points of the current pair are taken
};

}  // namespace pbmpi::solver
