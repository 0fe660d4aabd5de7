#include "model/memory_rows.h"

#include <algorithm>
#include <bit>
#include <cstdint>
#include <vector>

namespace pbmpi::model {
namespace {

const double* take(const double* from, Vec3& vector) {
  vector = Vec3(from);
  return from + 3;
}
const double* take(const double* from, int& index) {
  index = static_cast<int>(*from);
  return from + 1;
}
const double* take(const double* from, Pose& pose) {
  pose.position = Vec3(from);
  pose.orientation = {from[3], from[4], from[5], from[6]};
  return from + 7;
}

double* put(const Pose& pose, double* to) {
  to = std::copy_n(pose.position.data(), 3, to);
  const Quat& q = pose.orientation;
  for (const double number : {q.w, q.x, q.y, q.z}) *to++ = number;
  return to;
}

}  // namespace

double* put_row(const ContactForce& force, double* to) {
  for (const int index : {force.geoms.first, force.geoms.second, force.body_a, force.body_b}) *to++ = index;
  to = std::copy_n(force.arm.data(), 3, to);
  *to++ = force.normal;
  return std::copy_n(force.friction.data(), 3, to);
}

double* put_row(const JointForce& force, double* to) {
  to = std::copy_n(force.force.data(), 3, to);
  to = std::copy_n(force.torque.data(), 3, to);
  for (const double* pair : {force.control, force.rotor, force.angle}) to = std::copy_n(pair, 2, to);
  return to;
}

double* put_row(const Rest& rest, double* to) {
  to = put(Pose{rest.position, rest.orientation}, to);
  *to++ = rest.idle_steps;
  for (const Vec3* vector : {&rest.velocity, &rest.angular_velocity}) to = std::copy_n(vector->data(), 3, to);
  for (const MotionWatch& watch : rest.watches) {
    *to++ = watch.steps;
    for (const Pose& knot : watch.knots) to = put(knot, to);
    *to++ = watch.tremble;
    *to++ = watch.angular_tremble;
  }
  return to;
}

const double* take_row(const double* from, ContactForce& force) {
  for (int* index : {&force.geoms.first, &force.geoms.second, &force.body_a, &force.body_b})
    from = take(from, *index);
  from = take(from, force.arm);
  force.normal = *from++;
  return take(from, force.friction);
}

const double* take_row(const double* from, JointForce& force) {
  from = take(from, force.force);
  from = take(from, force.torque);
  for (double* pair : {force.control, force.rotor, force.angle}) {
    std::copy_n(from, 2, pair);
    from += 2;
  }
  return from;
}

const double* take_row(const double* from, Rest& rest) {
  Pose near;
  from = take(from, near);
  rest.position = near.position;
  rest.orientation = near.orientation;
  from = take(from, rest.idle_steps);
  for (Vec3* vector : {&rest.velocity, &rest.angular_velocity}) from = take(from, *vector);
  for (MotionWatch& watch : rest.watches) {
    from = take(from, watch.steps);
    for (Pose& knot : watch.knots) from = take(from, knot);
    watch.tremble = *from++;
    watch.angular_tremble = *from++;
  }
  return from;
}

void add_bits(const StepMemory& memory, core::Hash64& hash) {
  std::array<double, numbers_of_contact_force> contact_row;
  for (const ContactForce& force : memory.contacts) {
    put_row(force, contact_row.data());
    hash.add(contact_row.data(), contact_row.size());
  }
  std::array<double, numbers_of_joint_force> joint_row;
  const auto is_zero = [](double number) { return std::bit_cast<std::uint64_t>(number) == 0; };
  for (std::size_t joint = 0; joint < memory.joints.size(); ++joint) {
    put_row(memory.joints[joint], joint_row.data());
    if (std::all_of(joint_row.begin(), joint_row.end(), is_zero)) continue;
    hash.add(static_cast<std::uint64_t>(joint));
    hash.add(joint_row.data(), joint_row.size());
  }
}

void forget(const Model& model, int body, StepMemory& memory) {
  std::erase_if(memory.contacts, [body](const ContactForce& contact) {
    return contact.body_a == body || contact.body_b == body;
  });
  for (std::size_t joint = 0; joint < memory.joints.size(); ++joint) {
    const Joint& one = model.joints[joint];
    if (one.body_a == body || one.body_b == body) memory.joints[joint] = {};
  }
}

}  // namespace pbmpi::model
