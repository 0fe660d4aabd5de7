#include "mpi/spaces/step/wire.h"

#include <algorithm>
#include <cstring>

namespace pbmpi::mpi {

WireContact to_wire(const model::Contact& contact) {
  WireContact wire;
  wire.first = contact.geoms.first;
  wire.second = contact.geoms.second;
  wire.body_a = contact.body_a;
  wire.body_b = contact.body_b;
  std::memcpy(wire.position, contact.position.data(), sizeof wire.position);
  std::memcpy(wire.normal, contact.normal.data(), sizeof wire.normal);
  wire.depth = contact.depth;
  wire.mu = contact.mu;
  wire.restitution = contact.restitution;
  return wire;
}

model::Contact from_wire(const WireContact& wire) {
  model::Contact contact;
  contact.geoms = {wire.first, wire.second};
  contact.body_a = wire.body_a;
  contact.body_b = wire.body_b;
  contact.position = model::Vec3(wire.position);
  contact.normal = model::Vec3(wire.normal);
  contact.depth = wire.depth;
  contact.mu = wire.mu;
  contact.restitution = wire.restitution;
  return contact;
}

void merge_contacts(std::span<const WireContact> from, std::vector<model::Contact>& to) {
  const auto old = std::ssize(to);
  for (const WireContact& contact : from) to.push_back(from_wire(contact));
  // All contacts of a pair of geoms come from one list, which keeps their order.
  std::inplace_merge(to.begin(), to.begin() + old, to.end(),
                     [](const model::Contact& a, const model::Contact& b) { return a.geoms < b.geoms; });
}

namespace {

double* append_pose(const model::State& state, int body, double* row) {
  std::memcpy(row, state.position[body].data(), 3 * sizeof(double));
  const model::Quat& q = state.orientation[body];
  row[3] = q.w;
  row[4] = q.x;
  row[5] = q.y;
  row[6] = q.z;
  return row + model::numbers_of_pose;
}

}  // namespace

std::vector<double> state_rows(const model::State& state, std::span<const int> bodies) {
  std::vector<double> rows(model::numbers_of_state * bodies.size());
  double* row = rows.data();
  for (const int body : bodies) {
    row = append_pose(state, body, row);
    std::memcpy(row, state.velocity[body].data(), 3 * sizeof(double));
    std::memcpy(row + 3, state.angular_velocity[body].data(), 3 * sizeof(double));
    row += 6;
  }
  return rows;
}

std::vector<double> pose_rows(const model::State& state, std::span<const int> bodies) {
  std::vector<double> rows(model::numbers_of_pose * bodies.size());
  double* row = rows.data();
  for (const int body : bodies) row = append_pose(state, body, row);
  return rows;
}

std::vector<int> bodies_of(const model::SpaceMap& map, std::span<const int> units) {
  std::vector<int> bodies;
  for (const int unit : units)
    bodies.insert(bodies.end(), map.bodies_of_unit[unit].begin(), map.bodies_of_unit[unit].end());
  return bodies;
}

}  // namespace pbmpi::mpi
