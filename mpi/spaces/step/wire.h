/// Contacts in the form that messages hold.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "model/contact.h"
#include "model/space_map.h"

namespace pbmpi::mpi {

/// A model::Contact in the form that messages hold, with every bit kept.
struct WireContact {
  std::int32_t first = 0, second = 0;  ///< geoms
  std::int32_t body_a = 0, body_b = 0;
  double position[3] = {}, normal[3] = {};
  double depth = 0, mu = 0, restitution = 0, approach = 0;
};

WireContact to_wire(const model::Contact& contact);
model::Contact from_wire(const WireContact& contact);
/// Merges `from` into `to`, both in canonical order.
void merge_contacts(std::span<const WireContact> from, std::vector<model::Contact>& to);

/// The bodies of these units, unit by unit.
std::vector<int> bodies_of(const model::SpaceMap& map, std::span<const int> units);

}  // namespace pbmpi::mpi
