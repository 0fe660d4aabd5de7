/// The words by which enumerations appear in scene files, options and HDF5 files.
#pragma once

#include <array>
#include <optional>
#include <string_view>

#include "model/model.h"

namespace pbmpi::model {

inline constexpr std::array<std::string_view, num_actor_kinds> actor_kind_names = {
    "ground", "ramp", "wall", "car", "tank", "human", "centipede", "projectile", "prop"};
inline constexpr std::array<std::string_view, num_shapes> shape_names = {"sphere", "box", "capsule",
                                                                         "cylinder", "plane"};
inline constexpr std::array<std::string_view, num_joint_kinds> joint_kind_names = {
    "ball", "hinge", "slider", "universal", "fixed", "hinge2"};

constexpr std::string_view name_of(ActorKind kind) { return actor_kind_names[static_cast<int>(kind)]; }
constexpr std::string_view name_of(Shape shape) { return shape_names[static_cast<int>(shape)]; }
constexpr std::string_view name_of(JointKind kind) { return joint_kind_names[static_cast<int>(kind)]; }

/// The enumerator whose name stands in `names`, or nothing.
template <class Enum, std::size_t N>
constexpr std::optional<Enum> enum_from_name(std::string_view name,
                                             const std::array<std::string_view, N>& names) {
  for (std::size_t i = 0; i < N; ++i) {
    if (names[i] == name) return static_cast<Enum>(i);
  }
  return std::nullopt;
}

}  // namespace pbmpi::model
