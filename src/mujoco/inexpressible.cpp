#include <algorithm>
#include <string>

#include <mujoco/mujoco.h>

#include "effects/effects.h"
#include "model/joint_traits.h"
#include "mujoco/constraints.h"
#include "mujoco/mujoco_stepper.h"
#include "mujoco/tree/joint_tree.h"

namespace pbmpi::mujoco {
namespace {

using effects::EffectId;

using Sentences = std::vector<std::string>;

void refuse_axes(const model::Joint& joint, Sentences& sentences) {
  const model::JointTraits& traits = model::traits_of(joint.kind);
  const std::string name = "joint '" + joint.name + "'";
  for (int axis = 0; axis < 2; ++axis) {
    const std::string of_axis = " on axis " + std::to_string(axis + 1) + ", which its kind ";
    if (joint.motors[axis].active() && !traits.axes[axis].has_motor)
      sentences.push_back(name + " has a motor" + of_axis + "does not have");
    if (joint.limits[axis].active() && !traits.axes[axis].has_limit)
      sentences.push_back(name + " has a limit" + of_axis + "cannot limit");
  }
}

void refuse_parallel_axes(const model::Model& model, const model::Joint& joint, Sentences& sentences) {
  if (model::traits_of(joint.kind).num_axes < 2) return;
  constexpr double least_sine = 1e-3;
  const model::Vec3 axis1 = start_of(model, joint.body_a).direction_to_outer(joint.axis1_a);
  const model::Vec3 axis2 = start_of(model, joint.body_b).direction_to_outer(joint.axis2_b);
  if (axis1.cross(axis2).norm() < least_sine)
    sentences.push_back("the two axes of joint '" + joint.name + "' are parallel");
}

void refuse_loops(const model::Model& model, Sentences& sentences) {
  const std::vector<bool> controls = joints_with_controls(model);
  for (const int joint : make_joint_tree(model, {}).closing) {
    const std::string problem = closing_problem(model.joints[joint], controls[joint]);
    if (!problem.empty()) sentences.push_back(problem);
  }
}

void note_restitution(const effects::StepPlan& plan, Sentences& sentences) {
  if (plan.has(EffectId::restitution) && !plan.is_idle(EffectId::restitution))
    sentences.push_back("its contacts do not bounce: MuJoCo has no coefficient of restitution");
}

void note_friction(const model::Model& model, Sentences& sentences) {
  const bool unbounded = std::ranges::any_of(
      model.geoms, [](const model::Geom& geom) { return geom.material.mu == model::infinity; });
  if (unbounded) sentences.push_back("friction without bound is a coefficient of 100 in MuJoCo");
}

void note_softness(const model::Model& model, Sentences& sentences) {
  if (model.contact_law.soft_cfm > 0)
    sentences.push_back("MuJoCo's contacts have a softness of their own in place of soft_cfm");
}

}  // namespace

std::vector<std::string> refusals(const model::Model& model) {
  Sentences sentences;
  if (effects::StepPlan(model).has(EffectId::sleeping))
    sentences.push_back("the effect 'sleeping' is not there with MuJoCo; leave it out (--effects -sleeping)");
  for (const model::Joint& joint : model.joints) {
    refuse_axes(joint, sentences);
    refuse_parallel_axes(model, joint, sentences);
  }
  refuse_loops(model, sentences);
  if (std::ranges::any_of(model.geoms,
                          [](const model::Geom& geom) { return geom.shape == model::Shape::mesh; }))
    sentences.push_back(
        "a mesh of triangles or a height field is not there with MuJoCo, whose meshes are hulls");
  for (const model::Geom& geom : model.geoms) {
    if (geom.shape == model::Shape::plane && geom.body != model::no_body)
      sentences.push_back("body '" + model.bodies[geom.body].name +
                          "' has a plane, which in MuJoCo belongs to the environment alone");
  }
  return sentences;
}

std::vector<std::string> inexpressible(const model::Model& model) {
  Sentences sentences = refusals(model);
  const effects::StepPlan plan(model);
  note_restitution(plan, sentences);
  note_friction(model, sentences);
  note_softness(model, sentences);
  if (plan.has(EffectId::fast_bodies))
    sentences.push_back(
        "fast bodies may pass through others: MuJoCo looks for contacts at the step's start alone");
  if (plan.has(EffectId::field_of_interest))
    sentences.push_back("all of the world gets all iterations, inside and outside of the field of interest");
  if (effects::is_left_out(model, EffectId::gyroscopic_torque))
    sentences.push_back("the gyroscopic torque is there all the same");
  return sentences;
}

std::string mujoco_version() { return mj_versionString(); }

}  // namespace pbmpi::mujoco
