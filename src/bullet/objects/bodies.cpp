#include "bullet/objects/bodies.h"

#include <cmath>

#include <Eigen/Eigenvalues>

#include "effects/effects.h"
#include "model/mechanics.h"

namespace pbmpi::bullet {
namespace {

bool is_diagonal(const model::Mat3& inertia) {
  return inertia(0, 1) == 0 && inertia(0, 2) == 0 && inertia(1, 2) == 0;
}

/// Moments of inertia [kg m^2] and their axes as a right-handed rotation.
struct Principal {
  model::Vec3 moments;
  Eigen::Quaterniond axes = Eigen::Quaterniond::Identity();
};

Principal principal_of(const model::Mat3& inertia) {
  if (is_diagonal(inertia)) return {inertia.diagonal()};
  const Eigen::SelfAdjointEigenSolver<model::Mat3> solver(inertia);
  model::Mat3 axes = solver.eigenvectors();
  if (axes.determinant() < 0) axes.col(0) *= -1;
  return {solver.eigenvalues(), Eigen::Quaterniond(axes).normalized()};
}

std::unique_ptr<btRigidBody> make_body(double mass_kg, const model::Vec3& moments, btCollisionShape& shape) {
  const btRigidBody::btRigidBodyConstructionInfo info(mass_kg, nullptr, &shape, to_bullet(moments));
  return std::make_unique<btRigidBody>(info);
}

bool is_finite(const btVector3& v) {
  return std::isfinite(v.x()) && std::isfinite(v.y()) && std::isfinite(v.z());
}

}  // namespace

Bodies::Bodies(const model::Model& model) : no_shape_(std::make_unique<btEmptyShape>()) {
  const bool gyroscopic = !effects::is_left_out(model, effects::EffectId::gyroscopic_torque);
  const std::vector<model::Mat3> inertias = model::inertias_with_armatures(model);
  for (std::size_t body = 0; body < inertias.size(); ++body) {
    const Principal principal = principal_of(inertias[body]);
    bodies_.push_back(make_body(model.bodies[body].mass_kg, principal.moments, *no_shape_));
    bodies_.back()->setFlags(gyroscopic ? BT_ENABLE_GYROSCOPIC_FORCE_IMPLICIT_BODY : 0);
    bodies_.back()->forceActivationState(DISABLE_DEACTIVATION);
    const Eigen::Quaterniond& axes = principal.axes;
    principal_.emplace_back(axes.x(), axes.y(), axes.z(), axes.w());
    is_turned_.push_back(is_diagonal(inertias[body]) ? 0 : 1);
  }
  orientation_.resize(bodies_.size());
  ground_ = make_body(0, model::Vec3::Zero(), *no_shape_);
  restore(model::initial_state(model));
}

btTransform Bodies::local(int body, const btTransform& in_model) const {
  if (body == model::no_body || is_turned_[static_cast<std::size_t>(body)] == 0) return in_model;
  return btTransform(principal_[static_cast<std::size_t>(body)].inverse()) * in_model;
}

model::Vec3 Bodies::to_world(int body, const model::Vec3& local) const {
  return orientation_[static_cast<std::size_t>(body)].to_eigen() * local;
}

btTransform Bodies::frame(int body, const model::Vec3& position, const model::Quat& orientation) const {
  const auto at = static_cast<std::size_t>(body);
  const btQuaternion q = to_bullet(orientation);
  return btTransform(is_turned_[at] != 0 ? q * principal_[at] : q, to_bullet(position));
}

void Bodies::place(int body, const model::Vec3& position, const model::Quat& orientation) {
  orientation_[static_cast<std::size_t>(body)] = orientation;
  (*this)[body].setCenterOfMassTransform(frame(body, position, orientation));
}

void Bodies::set_velocity(int body, const model::Vec3& velocity, const model::Vec3& angular_velocity) {
  (*this)[body].setLinearVelocity(to_bullet(velocity));
  (*this)[body].setAngularVelocity(to_bullet(angular_velocity));
}

void Bodies::restore(const model::State& state) {
  for (int i = 0; i < size(); ++i) {
    const auto at = static_cast<std::size_t>(i);
    place(i, state.position[at], state.orientation[at]);
    set_velocity(i, state.velocity[at], state.angular_velocity[at]);
  }
}

/// Of the two quaternions of a rotation, takes the one nearer to the last one.
void Bodies::settle(int body) {
  const auto at = static_cast<std::size_t>(body);
  const btTransform& frame = (*this)[body].getCenterOfMassTransform();
  btQuaternion q = frame.getRotation();
  if (is_turned_[at] != 0) q = q * principal_[at].inverse();
  q.normalize();
  if (q.dot(to_bullet(orientation_[at])) < 0) q = -q;
  place(body, vec3(frame.getOrigin()), {q.w(), q.x(), q.y(), q.z()});
}

void Bodies::copy_out(model::State& state) const {
  for (int i = 0; i < size(); ++i) {
    const auto at = static_cast<std::size_t>(i);
    state.position[at] = vec3((*this)[i].getCenterOfMassPosition());
    state.orientation[at] = orientation_[at];
    state.velocity[at] = vec3((*this)[i].getLinearVelocity());
    state.angular_velocity[at] = vec3((*this)[i].getAngularVelocity());
  }
}

bool Bodies::is_finite(int body) const {
  const btRigidBody& one = (*this)[body];
  const model::Quat& q = orientation_[static_cast<std::size_t>(body)];
  return bullet::is_finite(one.getCenterOfMassPosition()) && bullet::is_finite(one.getLinearVelocity()) &&
         bullet::is_finite(one.getAngularVelocity()) && std::isfinite(q.w) && std::isfinite(q.x) &&
         std::isfinite(q.y) && std::isfinite(q.z);
}

void Bodies::show_awake(int body, bool awake) {
  (*this)[body].forceActivationState(awake ? DISABLE_DEACTIVATION : ISLAND_SLEEPING);
}

}  // namespace pbmpi::bullet
