#include "solver/parts/loaded_islands.h"

#include "geometry/body_size.h"
#include "model/joint_gap.h"
#include "solver/pack/step_settings.h"

namespace pbmpi::solver {
namespace {

/// A spring that is open by less than this share of its give is held by stiffer springs than the give was
/// computed for. Soft springs at rest are open by all of it, stiff ones by less, even one step after they
/// have become stiff.
constexpr double opened_by_soft_ones = 0.9;

}  // namespace

LoadedIslands::LoadedIslands(const model::Model& model, const stepping::StepperSettings& settings)
    : model_(&model),
      sag_m_(settings.sag_m),
      contact_give_(contact_spring(settings).give_in(substep_s(settings))),
      place_give_(joint_place_spring(settings).give_in(substep_s(settings))),
      turn_give_(joint_turn_spring(settings).give_in(substep_s(settings))),
      is_among_(model.bodies.size(), 0) {
  for (const model::Body& body : model.bodies) inverse_inertia_.push_back(body.inertia.inverse());
  for (const double size : geometry::sizes_of(model)) radius_m_.push_back(size / 2);
  // A matrix lengthens no vector by more than its Frobenius norm.
  const auto most_at = [&](int body, double arm) {
    if (body == model::no_body) return 0.0;
    const auto b = static_cast<std::size_t>(body);
    return 1 / model.bodies[b].mass_kg + arm * arm * inverse_inertia_[b].norm();
  };
  const auto most_turning = [&](int body) {
    if (body == model::no_body) return 0.0;
    const auto b = static_cast<std::size_t>(body);
    return radius_m_[b] * inverse_inertia_[b].norm();
  };
  for (int body = 0; body < model.num_bodies(); ++body)
    most_mobility_.push_back(most_at(body, radius_m_[static_cast<std::size_t>(body)]));
  for (const model::Joint& joint : model.joints) {
    joint_bounds_.push_back(
        {most_at(joint.body_a, joint.anchor_a.norm()) + most_at(joint.body_b, joint.anchor_b.norm()),
         most_turning(joint.body_a) + most_turning(joint.body_b)});
  }
}

bool LoadedIslands::gives_little(const model::ContactForce& force) const {
  double most = most_mobility_[static_cast<std::size_t>(force.body_a)];
  if (force.body_b != model::no_body) most += most_mobility_[static_cast<std::size_t>(force.body_b)];
  return is_little(contact_give_ * force.normal * most);
}

bool LoadedIslands::gives_little(std::size_t joint, const model::JointForce& force) const {
  const JointBounds& most = joint_bounds_[joint];
  return is_little(place_give_ * force.force.norm() * most.force +
                   turn_give_ * force.torque.norm() * most.torque);
}

model::Vec3 LoadedIslands::turned_by(int body, const model::Vec3& torque, const model::State& state) const {
  const auto b = static_cast<std::size_t>(body);
  const model::Mat3 rotation = state.orientation[b].to_eigen().toRotationMatrix();
  return rotation * (inverse_inertia_[b] * (rotation.transpose() * torque));
}

double LoadedIslands::mobility(int body, const model::Vec3& arm, const model::Vec3& along,
                               const model::State& state) const {
  if (body == model::no_body) return 0;
  const model::Vec3 torque = arm.cross(along);
  return 1 / model_->bodies[static_cast<std::size_t>(body)].mass_kg +
         torque.dot(turned_by(body, torque, state));
}

double LoadedIslands::turning_mobility(int body, const model::Vec3& about, const model::State& state) const {
  if (body == model::no_body) return 0;
  return radius_m_[static_cast<std::size_t>(body)] * about.dot(turned_by(body, about, state));
}

double LoadedIslands::give_of(const model::Contact& contact, const model::ContactForce& force,
                              const model::State& state) const {
  if (force.normal == 0) return 0;
  const auto arm = [&](int body) -> model::Vec3 {
    return contact.position - state.position[static_cast<std::size_t>(body)];
  };
  double mobility_of_both = mobility(contact.body_a, arm(contact.body_a), contact.normal, state);
  if (contact.body_b != model::no_body)
    mobility_of_both += mobility(contact.body_b, arm(contact.body_b), contact.normal, state);
  return contact_give_ * force.normal * mobility_of_both;
}

double LoadedIslands::give_of(const model::Joint& joint, const model::JointForce& force,
                              const model::State& state) const {
  const auto arm = [&](int body, const model::Vec3& anchor) -> model::Vec3 {
    if (body == model::no_body) return model::Vec3::Zero();
    return state.orientation[static_cast<std::size_t>(body)].to_eigen() * anchor;
  };
  double give = 0;
  if (const double pull = force.force.norm(); pull != 0) {
    const model::Vec3 along = force.force / pull;
    give += place_give_ * pull *
            (mobility(joint.body_a, arm(joint.body_a, joint.anchor_a), along, state) +
             mobility(joint.body_b, arm(joint.body_b, joint.anchor_b), along, state));
  }
  if (const double torque = force.torque.norm(); torque != 0) {
    const model::Vec3 about = force.torque / torque;
    give += turn_give_ * torque *
            (turning_mobility(joint.body_a, about, state) + turning_mobility(joint.body_b, about, state));
  }
  return give;
}

/// NaN counts as too much.
bool LoadedIslands::is_loaded(double give, double opened) const {
  if (is_little(give)) return false;
  const bool is_held_by_stiff_ones = opened < opened_by_soft_ones * give;
  return is_held_by_stiff_ones || !(give <= sag_m_);
}

void LoadedIslands::find(std::span<const int> bodies, std::span<const model::Contact> contacts,
                         std::span<const model::ContactForce> forces, std::span<const std::int32_t> broken_in,
                         const model::State& state, std::vector<int>& loaded) {
  for (const int body : bodies) is_among_[static_cast<std::size_t>(body)] = 1;
  for (std::size_t i = 0; i < contacts.size() && i < forces.size(); ++i) {
    if (is_among_[static_cast<std::size_t>(contacts[i].body_a)] == 0 || gives_little(forces[i])) continue;
    const double give = give_of(contacts[i], forces[i], state);
    if (is_loaded(give, contacts[i].depth)) loaded.push_back(contacts[i].body_a);
  }
  for (std::size_t i = 0; i < state.memory.joints.size(); ++i) {
    const model::Joint& joint = model_->joints[i];
    if (is_among_[static_cast<std::size_t>(joint.body_a)] == 0) continue;
    if (gives_little(i, state.memory.joints[i])) continue;
    if (!broken_in.empty() && broken_in[i] != model::unbroken) continue;
    const double give = give_of(joint, state.memory.joints[i], state);
    if (is_loaded(give, model::joint_gap(*model_, state, joint))) loaded.push_back(joint.body_a);
  }
  for (const int body : bodies) is_among_[static_cast<std::size_t>(body)] = 0;
}

}  // namespace pbmpi::solver
