/// What follows from the shape of a geom alone, in one table.
#pragma once

#include <array>
#include <cstddef>
#include <string_view>

#include "model/model.h"

namespace pbmpi::model {

/// Stands for a size that a shape does not have.
inline constexpr int no_size = -1;

/// A shape is a box, of which any side may be 0, widened by a radius: by a ball about each of its points
/// (`is_round`), or by a disc across z. A plane has no such description; a hull and a mesh
/// lie within their boxes.
struct ShapeTraits {
  Shape shape;
  std::string_view name;
  int num_sizes;  ///< how many of Geom::size it uses
  /// Which of its sizes is the full length along x, y and z.
  std::array<int, 3> length = {no_size, no_size, no_size};
  int radius = no_size;     ///< which size is the radius
  bool is_round = false;    ///< does the radius reach in all directions?
  bool has_points = false;  ///< is it given by points, from which its sizes follow?
};

/// In the order of Shape.
inline constexpr std::array<ShapeTraits, num_shapes> shape_traits = {{
    {.shape = Shape::sphere, .name = "sphere", .num_sizes = 1, .radius = 0, .is_round = true},
    {.shape = Shape::box, .name = "box", .num_sizes = 3, .length = {0, 1, 2}},
    {.shape = Shape::capsule,
     .name = "capsule",
     .num_sizes = 2,
     .length = {no_size, no_size, 1},
     .radius = 0,
     .is_round = true},
    {.shape = Shape::cylinder,
     .name = "cylinder",
     .num_sizes = 2,
     .length = {no_size, no_size, 1},
     .radius = 0},
    {.shape = Shape::plane, .name = "plane", .num_sizes = 0},
    {.shape = Shape::hull, .name = "hull", .num_sizes = 3, .length = {0, 1, 2}, .has_points = true},
    {.shape = Shape::mesh, .name = "mesh", .num_sizes = 3, .length = {0, 1, 2}, .has_points = true},
}};

constexpr const ShapeTraits& traits_of(Shape shape) { return shape_traits[static_cast<std::size_t>(shape)]; }

}  // namespace pbmpi::model
