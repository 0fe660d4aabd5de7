/// The forces of a StepMemory, and State::rest, as rows of numbers: the form in which they are hashed, sent
/// and written.
#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "core/hash.h"
#include "model/model.h"
#include "model/state.h"
#include "model/step_memory.h"

namespace pbmpi::model {

/// Adjacent numbers in a row that form one column of a table.
struct RowPart {
  const char* name;
  const char* unit;
  std::size_t width;
  bool is_index = false;  ///< whole numbers, which a double holds exactly
};

/// The parts of a row, in order.
inline constexpr std::array<RowPart, 5> contact_force_parts = {{{"geoms", "", 2, true},
                                                                {"bodies", "", 2, true},
                                                                {"arm", "m", 3},
                                                                {"normal", "N", 1},
                                                                {"friction", "N", 3}}};
inline constexpr std::array<RowPart, 5> joint_force_parts = {
    {{"force", "N", 3}, {"torque", "N m", 3}, {"control", "", 2}, {"rotor", "", 2}, {"angle", "", 2}}};
inline constexpr std::array<RowPart, 11> rest_parts = {{{"position", "m", 3},
                                                        {"orientation", "", 4},
                                                        {"idle_steps", "", 1, true},
                                                        {"velocity", "m s-1", 3},
                                                        {"angular_velocity", "rad s-1", 3},
                                                        {"short_steps", "", 1, true},
                                                        {"short_knots", "", 14},
                                                        {"short_tremble", "", 2},
                                                        {"long_steps", "", 1, true},
                                                        {"long_knots", "", 14},
                                                        {"long_tremble", "", 2}}};

template <std::size_t N>
constexpr std::size_t row_width(const std::array<RowPart, N>& parts) {
  std::size_t width = 0;
  for (const RowPart& part : parts) width += part.width;
  return width;
}
inline constexpr std::size_t numbers_of_contact_force = row_width(contact_force_parts);
inline constexpr std::size_t numbers_of_joint_force = row_width(joint_force_parts);
inline constexpr std::size_t numbers_of_rest = row_width(rest_parts);

/// Writes a row, every bit kept; returns where the next one begins.
double* put_row(const ContactForce& force, double* to);
double* put_row(const JointForce& force, double* to);
double* put_row(const Rest& rest, double* to);
/// Appends a row of `width` numbers for each item.
template <class Item>
void append_rows(std::vector<double>& rows, const std::vector<Item>& items, std::size_t width) {
  rows.resize(rows.size() + width * items.size());
  double* to = rows.data() + rows.size() - width * items.size();
  for (const Item& item : items) to = put_row(item, to);
}
/// Inverse of put_row(). The indices must be within the range of int.
const double* take_row(const double* from, ContactForce& force);
const double* take_row(const double* from, JointForce& force);
const double* take_row(const double* from, Rest& rest);

/// Adds all bits of a memory to a hash. A joint without force counts as none, so that having no joint entries
/// and having an entry of zeros for each joint give the same hash.
void add_bits(const StepMemory& memory, core::Hash64& hash);

/// Drops all remembered forces on a body, e.g. because it has been put elsewhere: its contacts, and the
/// forces of its joints.
void forget(const Model& model, int body, StepMemory& memory);

}  // namespace pbmpi::model
