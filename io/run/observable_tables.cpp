/// Group /observables: the columns of stepping/observable_table.h.
#include "io/run/frame_table.h"
#include "stepping/observable_table.h"

namespace pbmpi::io {
namespace {

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

}  // namespace pbmpi::io
