/// Group /observables: the columns of stepping/observable_table.h, the forces of joints, and the step in
/// which they broke.
#include <span>

#include "io/run/frame_table.h"
#include "stepping/observable_table.h"

namespace pbmpi::io {
namespace {

constexpr const auto& force_parts = model::parts_of<model::JointForce>;

template <class Owner>
ColumnSpec spec_of(const stepping::ObservableColumn<Owner>& column) {
  const hid_t type =
      std::holds_alternative<int Owner::*>(column.member) ? H5T_NATIVE_INT32 : H5T_NATIVE_DOUBLE;
  return {std::string(column.name), type, column.is_vector() ? hsize_t{3} : hsize_t{1},
          std::string(column.unit)};
}

template <class Columns>
std::vector<ColumnSpec> specs_of(const Columns& columns) {
  std::vector<ColumnSpec> specs;
  specs.reserve(columns.size());
  for (const auto& column : columns) specs.push_back(spec_of(column));
  return specs;
}

/// One item in each of these columns: the members of `owner`.
template <class Columns, class Owner>
void put_item(const Columns& columns, const Owner& owner, hsize_t item, GrowingTable& row) {
  for (std::size_t i = 0; i < columns.size(); ++i)
    stepping::with_member(columns[i], [&](auto member) { row.put(i, item, owner.*member); });
}

void put_worlds(const FrameSource& source, GrowingTable& row) {
  for (const stepping::LocalWorld& world : source.frame.worlds)
    put_item(stepping::world_observables, *world.observables, static_cast<hsize_t>(world.id), row);
}

void put_interest(const FrameSource& source, GrowingTable& row) {
  for (const stepping::LocalWorld& world : source.frame.worlds)
    put_item(stepping::interest_observables, *world.observables, static_cast<hsize_t>(world.id), row);
}

void put_residuals(const FrameSource& source, GrowingTable& row) {
  for (const stepping::LocalWorld& world : source.frame.worlds) {
    put_item(stepping::residual_observables, world.observables->residuals, static_cast<hsize_t>(world.id),
             row);
  }
}

void put_broken(const FrameSource& source, GrowingTable& row) {
  for (const stepping::LocalWorld& world : source.frame.worlds) {
    const std::vector<std::int32_t>& broken_in = world.state->broken_in;
    for (std::size_t j = 0; j < world.model->joints.size(); ++j)
      row.put(0, source.first_joint(world) + j, broken_in.empty() ? model::unbroken : broken_in[j]);
  }
}

/// Remembered forces are part of the state, and therefore of its hash. Otherwise a joint that does not act
/// has no force.
model::JointForce force_of(const stepping::LocalWorld& world, std::size_t joint) {
  const model::State& state = *world.state;
  if (!state.memory.joints.empty()) return state.memory.joints[joint];
  const auto body = static_cast<std::size_t>(world.model->joints[joint].body_a);
  const bool sleeps = !state.rest.empty() && state.rest[body].asleep();
  if (world.contacts == nullptr || world.contacts->joints.empty() || sleeps || state.is_broken(joint))
    return {};
  return world.contacts->joints[joint];
}

void put_forces(const FrameSource& source, GrowingTable& row) {
  for (const stepping::LocalWorld& world : source.frame.worlds) {
    for (std::size_t j = 0; j < world.model->joints.size(); ++j) {
      const hsize_t item = source.first_joint(world) + j;
      model::JointForce force = force_of(world, j);
      for (std::size_t i = 0; i < force_parts.size(); ++i) {
        const double* first = std::get<0>(force_parts[i].first)(force);
        row.put(i, item, std::span(first, force_parts[i].width));
      }
    }
  }
}

std::vector<ColumnSpec> force_columns() {
  std::vector<ColumnSpec> specs;
  specs.reserve(force_parts.size());
  for (const auto& part : force_parts) specs.push_back({part.name, H5T_NATIVE_DOUBLE, part.width, part.unit});
  return specs;
}

}  // namespace

std::vector<FrameTable> observable_tables(const OptionalColumns& optional) {
  std::vector<FrameTable> tables = {
      {"/observables/world", specs_of(stepping::world_observables), Items::worlds, Rows::frames, put_worlds}};
  if (optional.residuals) {
    tables.push_back({"/observables/residual", specs_of(stepping::residual_observables), Items::worlds,
                      Rows::frames, put_residuals});
  }
  if (optional.interest) {
    tables.push_back({"/observables/interest", specs_of(stepping::interest_observables), Items::worlds,
                      Rows::frames, put_interest});
  }
  return tables;
}

std::vector<FrameTable> joint_tables(const OptionalColumns& optional) {
  std::vector<FrameTable> tables;
  if (optional.breaks) {
    tables.push_back(
        {"/observables/joint", {{"broken_in", H5T_NATIVE_INT32}}, Items::joints, Rows::frames, put_broken});
  }
  if (optional.contacts) {
    tables.push_back({"/observables/joint", force_columns(), Items::joints, Rows::frames, put_forces});
  }
  return tables;
}

}  // namespace pbmpi::io
