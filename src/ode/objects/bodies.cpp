#include "ode/objects/bodies.h"

#include <algorithm>

#include "effects/effects.h"
#include "model/mechanics.h"

namespace pbmpi::ode {
namespace {

dMass mass_of(double mass_kg, const model::Mat3& inertia) {
  dMass mass;
  dMassSetParameters(&mass, mass_kg, 0, 0, 0, inertia(0, 0), inertia(1, 1), inertia(2, 2), inertia(0, 1),
                     inertia(0, 2), inertia(1, 2));
  return mass;
}

/// The setters mark the body's geoms as moved; the rounded values that they store are then overwritten.
void set_orientation_bits(dBodyID body, const model::Quat& orientation) {
  const dQuaternion q = {real(orientation.w), real(orientation.x), real(orientation.y), real(orientation.z)};
  dBodySetQuaternion(body, q);
  std::copy_n(q, 4, const_cast<dReal*>(dBodyGetQuaternion(body)));
  // As in dxStepBody after it has integrated q.
  dQtoR(q, const_cast<dReal*>(dBodyGetRotation(body)));
}

}  // namespace

std::vector<dBodyID> make_bodies(dWorldID world, const model::Model& model) {
  const bool gyroscopic = !effects::is_left_out(model, effects::EffectId::gyroscopic_torque);
  std::vector<dBodyID> bodies;
  bodies.reserve(model.bodies.size());
  const std::vector<model::Mat3> inertias = model::inertias_with_armatures(model);
  for (std::size_t body = 0; body < inertias.size(); ++body) {
    const dBodyID id = dBodyCreate(world);
    const dMass mass = mass_of(model.bodies[body].mass_kg, inertias[body]);
    dBodySetMass(id, &mass);
    dBodySetGyroscopicMode(id, gyroscopic ? 1 : 0);
    dBodySetAutoDisableFlag(id, 0);
    bodies.push_back(id);
  }
  restore(bodies, model::initial_state(model));
  return bodies;
}

void restore(const std::vector<dBodyID>& bodies, const model::State& state) {
  for (std::size_t i = 0; i < bodies.size(); ++i) {
    const model::Vec3& position = state.position[i];
    const model::Vec3& velocity = state.velocity[i];
    const model::Vec3& spin = state.angular_velocity[i];
    dBodySetPosition(bodies[i], position.x(), position.y(), position.z());
    set_orientation_bits(bodies[i], state.orientation[i]);
    dBodySetLinearVel(bodies[i], velocity.x(), velocity.y(), velocity.z());
    dBodySetAngularVel(bodies[i], spin.x(), spin.y(), spin.z());
  }
}

void copy_out(const std::vector<dBodyID>& bodies, model::State& state) {
  for (std::size_t i = 0; i < bodies.size(); ++i) {
    std::copy_n(dBodyGetPosition(bodies[i]), 3, state.position[i].data());
    const dReal* q = dBodyGetQuaternion(bodies[i]);
    state.orientation[i] = {q[0], q[1], q[2], q[3]};
    std::copy_n(dBodyGetLinearVel(bodies[i]), 3, state.velocity[i].data());
    std::copy_n(dBodyGetAngularVel(bodies[i]), 3, state.angular_velocity[i].data());
  }
}

}  // namespace pbmpi::ode
