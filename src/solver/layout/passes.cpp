#include "solver/layout/passes.h"

#include <algorithm>

#include "geometry/geometry.h"
#include "solver/layout/packed_world.h"

namespace pbmpi::solver {
namespace {

bool all_bodies_are_balls(const model::Model& model) {
  return std::all_of(model.geoms.begin(), model.geoms.end(), [](const model::Geom& geom) {
    return geom.body == model::no_body || geometry::is_ball(geom);
  });
}

}  // namespace

Passes passes_of(const model::Model& model) {
  const effects::StepPlan plan(model);
  const bool rubs = plan.has(effects::EffectId::friction) && !plan.is_idle(effects::EffectId::friction);
  return {plan.has(effects::EffectId::collision),    rubs || !all_bodies_are_balls(model),
          plan.has(effects::EffectId::restitution),  plan.has(effects::EffectId::gyroscopic_torque),
          plan.has(effects::EffectId::gravity),      plan.has(effects::EffectId::damping),
          plan.has(effects::EffectId::sleeping),     plan.has(effects::EffectId::field_of_interest),
          plan.is_idle(effects::EffectId::friction), plan.is_idle(effects::EffectId::limits),
          plan.is_idle(effects::EffectId::motors),   plan.is_idle(effects::EffectId::gyroscopic_torque)};
}

Passes shared_passes(std::span<const PackedWorld> worlds) {
  Passes all;
  for (const PackedWorld& world : worlds) {
    const Passes own = passes_of(*world.model);
    all.collision |= own.collision;
    all.turning_contacts |= own.turning_contacts;
    all.restitution |= own.restitution;
    all.gyroscopic_torque |= own.gyroscopic_torque;
    all.gravity |= own.gravity;
    all.damping |= own.damping;
    all.sleeping |= own.sleeping;
    all.field_of_interest |= own.field_of_interest;
    all.idle_friction |= own.idle_friction;
    all.idle_limits |= own.idle_limits;
    all.idle_motors |= own.idle_motors;
    all.idle_gyroscopic_torque |= own.idle_gyroscopic_torque;
  }
  return all;
}

}  // namespace pbmpi::solver
