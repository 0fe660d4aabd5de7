/// The words by which enumerations appear in scene files, options and HDF5 files.
#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <string_view>

#include "model/joint_traits.h"
#include "model/model.h"
#include "model/shape_traits.h"

namespace pbmpi::model {

inline constexpr std::array<std::string_view, num_actor_kinds> actor_kind_names = {
    "ground", "ramp", "wall", "car", "tank", "human", "centipede", "projectile", "prop"};

/// The names of a table of traits, in its order.
template <class Traits, std::size_t N>
constexpr std::array<std::string_view, N> names_in(const std::array<Traits, N>& table) {
  std::array<std::string_view, N> names;
  for (std::size_t i = 0; i < N; ++i) names[i] = table[i].name;
  return names;
}
inline constexpr auto shape_names = names_in(shape_traits);
inline constexpr auto joint_kind_names = names_in(joint_traits);

constexpr std::string_view name_of(ActorKind kind) { return actor_kind_names[static_cast<int>(kind)]; }
constexpr std::string_view name_of(Shape shape) { return traits_of(shape).name; }
constexpr std::string_view name_of(JointKind kind) { return traits_of(kind).name; }

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
