/// Rejects a model that no stepper can step.
#pragma once

#include <cstddef>
#include <string>

#include "core/error.h"
#include "model/model.h"

namespace pbmpi::model {

/// What is wrong with a model, and the actor that it is wrong with.
class ActorError : public core::InputError {
 public:
  ActorError(const std::string& message, std::size_t actor) : InputError(message), actor_(actor) {}

  std::size_t actor() const { return actor_; }  ///< index into Model::actors

 private:
  std::size_t actor_;
};

/// Throws core::InputError (ActorError where a body, geom, joint or event of an actor is the reason), whose
/// message begins with `where`, at the first of: no body; a mass that is not finite and positive; an inertia
/// that is not symmetric positive definite; a mass or inertia beyond what core/quantity.h allows; a
/// non-finite pose or velocity; a quaternion that is not of unit length (1e-9); an index out of range; a size
/// that is not positive; a joint between a body and itself; an axis that is not a unit vector; low > high; an
/// event before step 0; two bodies of one name; a field of interest without extent, or without iterations
/// outside.
void validate(const Model& model, const std::string& where);

/// Throws core::InputError where a joint has a motor, a limit or a second body of the world that its kind
/// cannot have.
void require_kind_has(const Joint& joint);

}  // namespace pbmpi::model
