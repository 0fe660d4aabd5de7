/// The one list of what a state consists of. From it follow the hash, the arrays in which states are sent and
/// saved, the columns of checkpoints and of a run's file, and the arrays of the library.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <tuple>
#include <type_traits>
#include <variant>
#include <vector>

#include "model/state.h"

namespace pbmpi::model {

/// What State holds of every body: one array each.
struct BodyColumn {
  const char* name;
  const char* unit;
  std::variant<std::vector<Vec3> State::*, std::vector<Quat> State::*> member;

  constexpr std::size_t width() const { return member.index() == 0 ? 3 : 4; }
  /// The numbers of all bodies: [num_bodies][width].
  std::span<double> of(State& state) const {
    return std::visit([&](auto array) { return numbers(state.*array); }, member);
  }
  std::span<const double> of(const State& state) const { return of(const_cast<State&>(state)); }
  /// The numbers of one body: [width].
  std::span<double> of(State& state, int body) const {
    return of(state).subspan(width() * static_cast<std::size_t>(body), width());
  }
  std::span<const double> of(const State& state, int body) const {
    return of(const_cast<State&>(state), body);
  }

 private:
  static double* first(Vec3& vector) { return vector.data(); }
  static double* first(Quat& q) { return &q.w; }
  template <class Item>
  static std::span<double> numbers(std::vector<Item>& items) {
    if (items.empty()) return {};
    return {first(items.front()), items.size() * sizeof(Item) / sizeof(double)};
  }
};

inline constexpr std::array<BodyColumn, 4> body_columns = {
    {{"position", "m", &State::position},
     {"orientation", "", &State::orientation},
     {"velocity", "m s-1", &State::velocity},
     {"angular_velocity", "rad s-1", &State::angular_velocity}}};
/// The columns of the pose.
inline constexpr std::span<const BodyColumn> pose_columns = std::span(body_columns).first<2>();

/// Numbers of a body in these columns.
constexpr std::size_t width_of(std::span<const BodyColumn> columns) {
  std::size_t width = 0;
  for (const BodyColumn& column : columns) width += column.width();
  return width;
}

/// The numbers of these bodies, [bodies][width_of(columns)]; and the inverse.
std::vector<double> body_rows(const State& state, std::span<const int> bodies,
                              std::span<const BodyColumn> columns = body_columns);
void put_body_rows(std::span<const double> rows, std::span<const int> bodies, State& state,
                   std::span<const BodyColumn> columns = body_columns);

/// Numbers side by side in a row of the state, which form one column of a table.
template <class Row>
struct RowPart {
  const char* name;
  const char* unit;
  std::size_t width;
  /// Where they begin; whole numbers are exact as doubles.
  std::variant<double* (*)(Row&), std::int32_t* (*)(Row&)> first;
};

/// The parts of a row, in order.
template <class Row>
inline constexpr std::array<RowPart<Row>, 0> parts_of = {};

template <>
inline constexpr auto parts_of<Rest> = std::to_array<RowPart<Rest>>({
    {"position", "m", 3, [](Rest& rest) { return rest.position.data(); }},
    {"orientation", "", 4, [](Rest& rest) { return &rest.orientation.w; }},
    {"idle_steps", "", 1, [](Rest& rest) { return &rest.idle_steps; }},
    {"velocity", "m s-1", 3, [](Rest& rest) { return rest.velocity.data(); }},
    {"angular_velocity", "rad s-1", 3, [](Rest& rest) { return rest.angular_velocity.data(); }},
    {"short_steps", "", 1, [](Rest& rest) { return &rest.watches[0].steps; }},
    {"short_knots", "", 14, [](Rest& rest) { return rest.watches[0].knots[0].position.data(); }},
    {"short_tremble", "", 2, [](Rest& rest) { return &rest.watches[0].tremble; }},
    {"long_steps", "", 1, [](Rest& rest) { return &rest.watches[1].steps; }},
    {"long_knots", "", 14, [](Rest& rest) { return rest.watches[1].knots[0].position.data(); }},
    {"long_tremble", "", 2, [](Rest& rest) { return &rest.watches[1].tremble; }},
});
/// An entry of State::broken_in, the only numbers of a state that are a row by themselves.
template <>
inline constexpr auto parts_of<std::int32_t> = std::to_array<RowPart<std::int32_t>>({
    {"broken_in", "", 1, [](std::int32_t& step) { return &step; }},
});
template <>
inline constexpr auto parts_of<ContactForce> = std::to_array<RowPart<ContactForce>>({
    {"geoms", "", 2, [](ContactForce& force) { return &force.geoms.first; }},
    {"bodies", "", 2, [](ContactForce& force) { return &force.body_a; }},
    {"arm", "m", 3, [](ContactForce& force) { return force.arm.data(); }},
    {"normal", "N", 1, [](ContactForce& force) { return &force.normal; }},
    {"friction", "N", 3, [](ContactForce& force) { return force.friction.data(); }},
});
template <>
inline constexpr auto parts_of<JointForce> = std::to_array<RowPart<JointForce>>({
    {"force", "N", 3, [](JointForce& force) { return force.force.data(); }},
    {"torque", "N m", 3, [](JointForce& force) { return force.torque.data(); }},
    {"control", "", 2, [](JointForce& force) { return force.control; }},
    {"rotor", "", 2, [](JointForce& force) { return force.rotor; }},
    {"angle", "rad", 2, [](JointForce& force) { return force.angle; }},
});
template <>
inline constexpr auto parts_of<GuardMemory> = std::to_array<RowPart<GuardMemory>>({
    {"energy_gain", "J", 1, [](GuardMemory& guard) { return &guard.energy_gain_j; }},
    {"largest_kinetic", "J", 1, [](GuardMemory& guard) { return &guard.largest_kinetic_j; }},
    {"frozen_in", "", 1, [](GuardMemory& guard) { return &guard.frozen_in; }},
});

/// Numbers of a row.
template <class Row>
inline constexpr std::size_t row_width = [] {
  std::size_t width = 0;
  for (const RowPart<Row>& part : parts_of<Row>) width += part.width;
  return width;
}();

/// Writes a row, every bit kept; returns where the next one begins.
template <class Row>
double* put_row(const Row& row, double* to) {
  const auto put = [&](auto first, std::size_t width) {
    to = std::copy_n(first(const_cast<Row&>(row)), width, to);
  };
  for (const RowPart<Row>& part : parts_of<Row>)
    std::visit([&](auto first) { put(first, part.width); }, part.first);
  return to;
}
/// Inverse of put_row(). Whole numbers must be within the range of int.
template <class Row>
const double* take_row(const double* from, Row& row) {
  const auto take = [&](auto first, std::size_t width) {
    auto* number = first(row);
    for (; width > 0; --width) *number++ = static_cast<std::remove_pointer_t<decltype(number)>>(*from++);
  };
  for (const RowPart<Row>& part : parts_of<Row>)
    std::visit([&](auto first) { take(first, part.width); }, part.first);
  return from;
}
template <class Row>
void append_row(const Row& row, std::vector<double>& rows) {
  rows.resize(rows.size() + row_width<Row>);
  put_row(row, &rows[rows.size() - row_width<Row>]);
}
template <class Row>
void append_rows(const std::vector<Row>& items, std::vector<double>& rows) {
  rows.reserve(rows.size() + row_width<Row> * items.size());
  for (const Row& item : items) append_row(item, rows);
}
/// Inverse of append_rows() for all of `rows`.
template <class Row>
std::vector<Row> take_rows(std::span<const double> rows) {
  std::vector<Row> items(rows.size() / row_width<Row>);
  const double* from = rows.data();
  for (Row& item : items) from = take_row(from, item);
  return items;
}

/// Rows of which a state has any number, and the names of their table and of their number in a checkpoint.
template <class Row>
struct RowList {
  const char* table;
  const char* count;
  std::vector<Row>& (*rows)(State&);

  std::vector<Row>& of(State& state) const { return rows(state); }
  const std::vector<Row>& of(const State& state) const { return rows(const_cast<State&>(state)); }
};

inline constexpr std::tuple row_lists = {
    RowList<Rest>{"rest", "resting", [](State& state) -> std::vector<Rest>& { return state.rest; }},
    RowList<std::int32_t>{"joints", "joints",
                          [](State& state) -> std::vector<std::int32_t>& { return state.broken_in; }},
    RowList<ContactForce>{"contact_forces", "contact_forces",
                          [](State& state) -> std::vector<ContactForce>& { return state.memory.contacts; }},
    RowList<JointForce>{"joint_forces", "joint_forces",
                        [](State& state) -> std::vector<JointForce>& { return state.memory.joints; }}};

/// Calls visit(list) for each RowList.
template <class Visit>
void for_each_list(Visit visit) {
  std::apply([&](const auto&... list) { (visit(list), ...); }, row_lists);
}

}  // namespace pbmpi::model
