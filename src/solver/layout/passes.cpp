#include "solver/layout/passes.h"

#include <algorithm>
#include <array>

#include "geometry/geometry.h"
#include "solver/layout/packed_world.h"

namespace pbmpi::solver {
namespace {

using effects::EffectId;

/// A pass that follows from one effect alone.
struct PassOfEffect {
  bool Passes::*pass;
  EffectId effect;
  bool only_idle;  ///< there only if the effect is demanded and nothing calls for it
};

constexpr std::array<PassOfEffect, 12> passes_of_effects = {{
    {&Passes::collision, EffectId::collision, false},
    {&Passes::fast_bodies, EffectId::fast_bodies, false},
    {&Passes::restitution, EffectId::restitution, false},
    {&Passes::gyroscopic_torque, EffectId::gyroscopic_torque, false},
    {&Passes::gravity, EffectId::gravity, false},
    {&Passes::damping, EffectId::damping, false},
    {&Passes::sleeping, EffectId::sleeping, false},
    {&Passes::field_of_interest, EffectId::field_of_interest, false},
    {&Passes::idle_friction, EffectId::friction, true},
    {&Passes::idle_limits, EffectId::limits, true},
    {&Passes::idle_motors, EffectId::motors, true},
    {&Passes::idle_gyroscopic_torque, EffectId::gyroscopic_torque, true},
}};

bool all_bodies_are_balls(const model::Model& model) {
  return std::all_of(model.geoms.begin(), model.geoms.end(), [](const model::Geom& geom) {
    return geom.body == model::no_body || geometry::is_ball(geom);
  });
}

}  // namespace

Passes passes_of(const model::Model& model) {
  const effects::StepPlan plan(model);
  Passes passes;
  for (const PassOfEffect& one : passes_of_effects)
    passes.*one.pass = one.only_idle ? plan.is_idle(one.effect) : plan.has(one.effect);
  const bool rubs = plan.has(EffectId::friction) && !plan.is_idle(EffectId::friction);
  passes.turning_contacts = rubs || !all_bodies_are_balls(model);
  return passes;
}

Passes shared_passes(std::span<const PackedWorld> worlds) {
  Passes shared;
  for (const PackedWorld& world : worlds) {
    const Passes own = passes_of(*world.model);
    for (const PassOfEffect& one : passes_of_effects) shared.*one.pass |= own.*one.pass;
    shared.turning_contacts |= own.turning_contacts;
    shared.in_parts |= world.in_parts;
  }
  return shared;
}

}  // namespace pbmpi::solver
