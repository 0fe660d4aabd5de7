/// Reads the load of a joint out of its rows.
#pragma once

#include <type_traits>

#include "solver/joints/joint_load.h"
#include "solver/joints/joint_rows.h"

namespace pbmpi::solver {

/// Of one lane of rows as last solved.
template <class T, model::JointKind kind>
JointLoad load_of(const JointRows<T, kind>& rows, int lane) {
  JointLoad load;
  const auto add = [&](const Vec3L<typename T::V>& direction, double impulse, double* sum) {
    sum[0] += impulse * T::get(direction.x, lane);
    sum[1] += impulse * T::get(direction.y, lane);
    sum[2] += impulse * T::get(direction.z, lane);
  };
  for (const auto& row : rows.points) add(row.impulse, 1, load.impulse);
  for_each_single_row(rows, [&](const auto& row) {
    const double impulse = T::get(row.impulse, lane);
    if constexpr (std::is_same_v<std::remove_cvref_t<decltype(row)>, AxisRow<typename T::V>>) {
      add(row.axis, impulse, load.turn);
    } else {
      add(row.direction, impulse, load.impulse);
      add(row.moment_a, impulse, load.moment);
    }
  });
  return load;
}

}  // namespace pbmpi::solver
