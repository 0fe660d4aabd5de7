/// What follows from the kind of a joint alone, in one table.
#pragma once

#include <array>
#include <cstddef>
#include <string_view>

#include "model/model.h"

namespace pbmpi::model {

/// What a joint holds of its bodies' positions.
enum class HeldPlace {
  anchor,            ///< the anchors of the two bodies coincide: 3 rows
  suspended_anchor,  ///< the anchors coincide, softly along axis 1 if the joint has a suspension: 3 rows
  line,              ///< the first body's centre of mass on a line along axis 1: 2 rows
  offset,            ///< the second body's centre of mass as seen from the first: 3 rows
};

/// What a joint holds of its bodies' orientations.
enum class HeldTurn {
  nothing,      ///< no row
  axis,         ///< axis 1 of both bodies parallel: 2 rows
  right_angle,  ///< axis 2 at right angles to axis 1: 1 row
  start_angle,  ///< the initial angle between axes 1 and 2: 1 row
  orientation,  ///< the initial relative orientation: 3 rows
};

/// What can act on an axis of a joint.
struct AxisTraits {
  bool has_motor = false;
  /// The axis then has a known coordinate too, so that its motor can hold a pose.
  bool has_limit = false;
};

struct JointTraits {
  JointKind kind;
  std::string_view name;
  HeldPlace place;
  HeldTurn turn;
  int num_axes;  ///< axis 1 is fixed in the first body, axis 2 in the second
  std::array<AxisTraits, 2> axes{};
  bool slides = false;            ///< do the bodies move along axis 1 [m] instead of turning about it [rad]?
  bool needs_two_bodies = false;  ///< it cannot join a body to the world

  constexpr bool has_anchor() const {
    return place == HeldPlace::anchor || place == HeldPlace::suspended_anchor;
  }
  constexpr bool has_suspension() const { return place == HeldPlace::suspended_anchor; }
  constexpr int place_rows() const { return place == HeldPlace::line ? 2 : 3; }
  constexpr int turn_rows() const {
    constexpr std::array<int, 5> rows = {0, 2, 1, 1, 3};  // in the order of HeldTurn
    return rows[static_cast<std::size_t>(turn)];
  }
  /// Degrees of freedom that the joint removes: its rows without limits and motors.
  constexpr int held_rows() const { return place_rows() + turn_rows(); }
};

/// In the order of JointKind.
inline constexpr std::array<JointTraits, num_joint_kinds> joint_traits = {{
    {JointKind::ball, "ball", HeldPlace::anchor, HeldTurn::nothing, 0},
    {JointKind::hinge, "hinge", HeldPlace::anchor, HeldTurn::axis, 1, {{{true, true}}}},
    {.kind = JointKind::slider,
     .name = "slider",
     .place = HeldPlace::line,
     .turn = HeldTurn::orientation,
     .num_axes = 1,
     .axes = {{{true, true}}},
     .slides = true},
    {JointKind::universal,
     "universal",
     HeldPlace::anchor,
     HeldTurn::right_angle,
     2,
     {{{true, true}, {true, true}}}},
    {JointKind::fixed, "fixed", HeldPlace::offset, HeldTurn::orientation, 0},
    {.kind = JointKind::hinge2,
     .name = "hinge2",
     .place = HeldPlace::suspended_anchor,
     .turn = HeldTurn::start_angle,
     .num_axes = 2,
     .axes = {{{true, true}, {true, false}}},
     .needs_two_bodies = true},
}};

constexpr const JointTraits& traits_of(JointKind kind) {
  return joint_traits[static_cast<std::size_t>(kind)];
}

/// Can the joint's bodies move along axis 1?
inline bool moves_along_axis(const Joint& joint) {
  const JointTraits& traits = traits_of(joint.kind);
  return traits.slides || (traits.has_suspension() && joint.suspension.stiffness > 0);
}

}  // namespace pbmpi::model
