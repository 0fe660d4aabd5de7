#include "solver/spaces/unit_memory.h"

#include <algorithm>

#include "core/error.h"
#include "model/state_parts.h"

namespace pbmpi::solver {
namespace {

using model::ContactForce;
using model::JointForce;

std::vector<char> mask_of(std::span<const int> units, const model::SpaceMap& map) {
  std::vector<char> mask(static_cast<std::size_t>(map.num_units()), 0);
  for (const int unit : units) mask[unit] = 1;
  return mask;
}

}  // namespace

std::vector<double> UnitMemory::rows(std::span<const int> units, const model::StepMemory& memory) const {
  const std::vector<char> chosen = mask_of(units, map);
  std::vector<double> rows(1);
  for (const ContactForce& force : memory.contacts) {
    if (!chosen[map.unit_of_body[force.body_a]]) continue;
    model::append_row(force, rows);
    ++rows.front();
  }
  if (memory.joints.empty()) return rows;
  for (const int unit : units) {
    for (const int joint : articulations[unit].joints) model::append_row(memory.joints[joint], rows);
  }
  return rows;
}

void UnitMemory::put(std::span<const int> units, std::span<const double> rows, std::size_t num_joints,
                     model::StepMemory& memory) const {
  core::require_invariant(!rows.empty(), "the forces of units begin with the number of contacts");
  const double* row = rows.data();
  const auto num_contacts = static_cast<std::size_t>(*row++);
  const std::size_t contacts_end = 1 + num_contacts * model::row_width<ContactForce>;
  const bool has_joints = rows.size() > contacts_end;
  std::size_t num_joint_rows = 0;
  for (const int unit : units) num_joint_rows += articulations[unit].joints.size();
  core::require_invariant(
      rows.size() == contacts_end + (has_joints ? num_joint_rows * model::row_width<JointForce> : 0),
      "the forces of units are as long as they say");

  const std::vector<char> chosen = mask_of(units, map);
  std::erase_if(memory.contacts,
                [&](const ContactForce& force) { return chosen[map.unit_of_body[force.body_a]] != 0; });
  const auto num_kept = std::ssize(memory.contacts);
  for (std::size_t i = 0; i < num_contacts; ++i) row = model::take_row(row, memory.contacts.emplace_back());
  // All points of a pair have the same body a, and hence arrived together.
  std::inplace_merge(memory.contacts.begin(), memory.contacts.begin() + num_kept, memory.contacts.end(),
                     [](const ContactForce& a, const ContactForce& b) { return a.geoms < b.geoms; });

  if (has_joints) memory.joints.resize(num_joints);
  if (memory.joints.empty()) return;
  for (const int unit : units) {
    for (const int joint : articulations[unit].joints) {
      memory.joints[joint] = {};
      if (has_joints) row = model::take_row(row, memory.joints[joint]);
    }
  }
}

}  // namespace pbmpi::solver
