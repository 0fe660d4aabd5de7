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
  wire.approach = contact.approach;
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
  contact.approach = wire.approach;
  return contact;
}

void merge_contacts(std::span<const WireContact> from, std::vector<model::Contact>& to) {
  const auto old = std::ssize(to);
  for (const WireContact& contact : from) to.push_back(from_wire(contact));
  // All contacts of a pair of geoms come from one list, which keeps their order.
  std::inplace_merge(to.begin(), to.begin() + old, to.end(),
                     [](const model::Contact& a, const model::Contact& b) { return a.geoms < b.geoms; });
}

std::vector<int> bodies_of(const model::SpaceMap& map, std::span<const int> units) {
  std::vector<int> bodies;
  for (const int unit : units)
    bodies.insert(bodies.end(), map.bodies_of_unit[unit].begin(), map.bodies_of_unit[unit].end());
  return bodies;
}

}  // namespace pbmpi::mpi
