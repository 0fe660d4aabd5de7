#include "bullet/bullet_stepper.h"

#include <algorithm>
#include <array>
#include <functional>

#include "effects/effects.h"
#include "model/joint_traits.h"

namespace pbmpi::bullet {
namespace {

using model::Model;

bool any_joint(const Model& model, const std::function<bool(const model::Joint&)>& holds) {
  return std::ranges::any_of(model.joints, holds);
}

bool has_suspension(const Model& model) {
  return any_joint(model, [](const model::Joint& joint) {
    return model::traits_of(joint.kind).has_suspension() && joint.suspension.stiffness > 0;
  });
}

bool has_limits(const Model& model) {
  return any_joint(model, [](const model::Joint& joint) {
    return std::ranges::any_of(joint.limits, &model::AxisLimit::active);
  });
}

bool has_joint_cfm(const Model& model) { return model.cfm > 1e-9 && !model.joints.empty(); }
bool has_many_contacts(const Model& model) { return model.contact_law.max_per_pair > 4; }
bool has_field(const Model& model) {
  return effects::StepPlan(model).has(effects::EffectId::field_of_interest);
}
bool has_no_slip(const Model& model) {
  return std::ranges::any_of(model.geoms,
                             [](const model::Geom& geom) { return geom.material.mu == model::infinity; });
}
bool has_gyroscopic_torque(const Model& model) {
  return effects::StepPlan(model).has(effects::EffectId::gyroscopic_torque);
}
bool always(const Model&) { return true; }

struct Difference {
  bool (*concerns)(const Model& model);
  const char* text;
};

/// The sources are those of Bullet 3.24.
constexpr std::array differences = {
    Difference{
        has_suspension,
        "suspension: a spring of Bullet's, explicit in the step, and no softer row by ERP and CFM; its "
        "stiffness is at most m / (16 dt^2), its damping m / dt, m the lighter body's mass"},
    Difference{has_limits,
               "limits: a row for each stop in every step, that slows the axis before it is there by ERP"},
    Difference{has_joint_cfm,
               "cfm of joints: none, Bullet's has another meaning; joints are as stiff as they can be"},
    Difference{has_many_contacts, "max_per_pair: a pair of geoms has 4 contacts at most"},
    Difference{has_field, "field_of_interest: none, all islands get all iterations"},
    Difference{has_no_slip, "infinite friction: 1e6 times the normal force at most"},
    Difference{
        has_gyroscopic_torque,
        "gyroscopic_torque: implicit, by one step of Newton's method, which takes energy from a fast spin"},
    Difference{always, "a body turns by a quarter of pi in a step at most (btTransformUtil)"},
    Difference{always,
               "contacts keep no memory from step to step, as quick's, so that a state restores a world"},
};

}  // namespace

std::vector<std::string> inexpressible(const Model& model) {
  std::vector<std::string> lines;
  for (const Difference& one : differences) {
    if (one.concerns(model)) lines.emplace_back(one.text);
  }
  return lines;
}

}  // namespace pbmpi::bullet
