/// What a joint exerted on its bodies, from the impulses of its rows.
#pragma once

#include "effects/breakage.h"
#include "model/contact.h"

namespace pbmpi::solver {

/// Sums over the rows of a joint as last solved, on its first body, world frame. Rows along lines all act at
/// one point: the anchor; of a fixed joint where the second body's centre of mass belongs, of a slider the
/// middle between the two (with the origin, if there is no second).
struct JointLoad {
  double impulse[3] = {};  ///< [N s] of rows along lines
  double moment[3] = {};   ///< [N m s] of line rows (hinge2, slider), about the body's centre of mass
  double turn[3] = {};     ///< [N m s] of rows about axes
};

/// As effects::Reaction has it. `first`: pose of the first body after the step; h [s]: the substep.
effects::Reaction reaction_of(const JointLoad& load, const model::Model& model, const model::Joint& joint,
                              const model::BodyPose& first, double h);

}  // namespace pbmpi::solver
