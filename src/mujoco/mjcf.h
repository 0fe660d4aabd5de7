/// Writes a world as MJCF text, MuJoCo's own format.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "model/model.h"
#include "mujoco/constraints.h"
#include "mujoco/tree/joint_links.h"
#include "stepping/stepper.h"

namespace pbmpi::mujoco {

/// Names that identify the parts in the compiled model: bodies and geoms are those of the model.
std::string body_name(int body);
std::string geom_name(int geom);
/// Name of the k-th axis of the link of a body.
std::string axis_name(int body, std::size_t k);

/// The data that the text is made from; all borrowed.
struct MjcfParts {
  const model::Model& model;
  const std::vector<Link>& links;
  const Constraints& constraints;
  std::span<const std::int32_t> broken_in;  ///< as in State
  const stepping::StepperSettings& settings;
};

/// Each body's frame is the model's: its origin is the centre of mass. Numbers read back to the same bits.
/// Limits, and which constraints are active, are set in the compiled model (drives.h, constraints.h).
/// `stack`: the stack size of the model, in numbers.
std::string mjcf_text(const MjcfParts& parts, int stack);

}  // namespace pbmpi::mujoco
