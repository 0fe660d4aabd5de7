#include "mpi/frame/whole_state.h"

#include <algorithm>
#include <string>
#include <tuple>

#include "core/error.h"
#include "model/state_parts.h"

namespace pbmpi::mpi {
namespace {

/// Numbers of rows of all kinds, with which the packed form begins: the bodies, and model::row_lists.
constexpr std::size_t num_lengths = 1 + std::tuple_size_v<decltype(model::row_lists)>;
constexpr std::size_t numbers_of_body = model::width_of(model::body_columns);

/// Numbers of a row of a RowList.
template <class Row>
constexpr std::size_t width_of(const model::RowList<Row>&) {
  return model::row_width<Row>;
}

std::size_t packed_size(const model::State& state) {
  std::size_t size =
      num_lengths + numbers_of_body * state.position.size() + model::row_width<model::GuardMemory>;
  model::for_each_list([&](const auto& list) { size += width_of(list) * list.of(state).size(); });
  return size;
}

/// Throws unless there is one entry for each joint of the model, or none at all.
void require_joints(int world, std::size_t num_joints, const model::Model& model) {
  if (num_joints == 0 || num_joints == model.joints.size()) return;
  throw core::RunError("world " + std::to_string(world) + " was built with " +
                       std::to_string(model.joints.size()) + " joints where it had " +
                       std::to_string(num_joints) + " before; a scene must build the same world each time");
}

/// Does the model have the geoms and bodies of a contact?
bool acts_in(const model::ContactForce& force, const model::Model& model) {
  const auto is_within = [](int index, int lowest, std::ptrdiff_t end) {
    return index >= lowest && index < end;
  };
  const std::ptrdiff_t num_geoms = std::ssize(model.geoms), num_bodies = std::ssize(model.bodies);
  return is_within(force.geoms.first, 0, num_geoms) && is_within(force.geoms.second, 0, num_geoms) &&
         is_within(force.body_a, 0, num_bodies) && is_within(force.body_b, model::no_body, num_bodies);
}

}  // namespace

std::vector<double> pack(const model::State& state) {
  std::vector<double> packed = {static_cast<double>(state.position.size())};
  packed.reserve(packed_size(state));
  model::for_each_list(
      [&](const auto& list) { packed.push_back(static_cast<double>(list.of(state).size())); });
  for (const model::BodyColumn& column : model::body_columns) {
    const std::span<const double> numbers = column.of(state);
    packed.insert(packed.end(), numbers.begin(), numbers.end());
  }
  model::for_each_list([&](const auto& list) { model::append_rows(list.of(state), packed); });
  model::append_row(state.guard, packed);
  return packed;
}

model::State unpack(std::span<const double> packed) {
  const auto refuse_unless = [&](bool fits) {
    if (fits) return;
    throw core::RunError("a packed state of " + std::to_string(packed.size()) +
                         " numbers has not the length that it begins with; run the same build on all ranks");
  };
  refuse_unless(packed.size() >= num_lengths);
  const double* from = packed.data();
  const auto next_length = [&](std::size_t width) {
    refuse_unless(*from >= 0 && *from * static_cast<double>(width) <= static_cast<double>(packed.size()));
    return static_cast<std::size_t>(*from++);
  };
  model::State state;
  state.resize(static_cast<int>(next_length(numbers_of_body)));
  model::for_each_list([&](const auto& list) { list.of(state).resize(next_length(width_of(list))); });
  refuse_unless(packed.size() == packed_size(state));
  for (const model::BodyColumn& column : model::body_columns) {
    const std::span<double> numbers = column.of(state);
    std::copy_n(from, numbers.size(), numbers.begin());
    from += numbers.size();
  }
  model::for_each_list([&](const auto& list) {
    for (auto& row : list.of(state)) from = model::take_row(from, row);
  });
  model::take_row(from, state.guard);
  return state;
}

void require_rows(int world, const model::State& state, const model::Model& model) {
  if (state.num_bodies() == model.num_bodies() &&
      (state.rest.empty() || std::ssize(state.rest) == model.num_bodies())) {
    return;
  }
  throw core::RunError("world " + std::to_string(world) + " was built with " +
                       std::to_string(model.num_bodies()) + " bodies where it had " +
                       std::to_string(state.num_bodies()) +
                       " before; a scene must build the same world each time");
}

void require_fit(int world, const model::State& state, const model::Model& model) {
  require_rows(world, state, model);
  require_joints(world, state.broken_in.size(), model);
  require_joints(world, state.memory.joints.size(), model);
  const auto fits = [&](const model::ContactForce& force) { return acts_in(force, model); };
  if (std::all_of(state.memory.contacts.begin(), state.memory.contacts.end(), fits)) return;
  throw core::RunError("world " + std::to_string(world) +
                       " was built without a body or geom on which a contact force of its state acts; "
                       "a scene must build the same world each time");
}

}  // namespace pbmpi::mpi
