/// What a joint exerted on its bodies, from the impulses of its rows.
#pragma once

#include <type_traits>

#include "effects/breakage.h"
#include "model/contact.h"
#include "solver/joints/joint_rows.h"

namespace pbmpi::solver {

/// Sums over the rows of a joint as last solved, on its first body, world frame. Rows along lines all act at
/// one point: the anchor; for a fixed joint where the second body's centre of mass belongs; for a slider the
/// midpoint of the two centres, or the body's centre if it slides on the world.
struct JointLoad {
  double impulse[3] = {};  ///< [N s] of rows along lines
  double turn[3] = {};     ///< [N m s] of rows about axes
};

/// The load in one lane of rows as last solved.
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
    }
  });
  return load;
}

/// The effects::Reaction of a load. `first`: pose of the first body after the step; `h` [s]: length of the
/// substep.
effects::Reaction reaction_of(const JointLoad& load, const model::Model& model, const model::Joint& joint,
                              const model::BodyPose& first, double h);

}  // namespace pbmpi::solver
