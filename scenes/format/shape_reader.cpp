#include "scenes/format/shape_reader.h"

#include <string_view>
#include <vector>

#include "model/shape_traits.h"

namespace pbmpi::scenes {

const std::vector<model::Shape>& solid_shapes() {
  static const std::vector<model::Shape> shapes = [] {
    std::vector<model::Shape> solid;
    for (const model::ShapeTraits& traits : model::shape_traits) {
      if (traits.num_sizes > 0) solid.push_back(traits.shape);
    }
    return solid;
  }();
  return shapes;
}

model::Shape read_shape(TableReader& table, std::span<const model::Shape> allowed) {
  std::vector<std::string_view> names;
  for (const model::Shape shape : allowed) names.push_back(model::traits_of(shape).name);
  return allowed[table.choice("shape", names)];
}

std::array<double, 3> read_size(TableReader& table, model::Shape shape) {
  const model::ShapeTraits& traits = model::traits_of(shape);
  std::array<double, 3> size{};
  if (traits.radius == model::no_size) {
    const core::Vec3 sides = table.vector("size", Sign::positive);
    return {sides.x(), sides.y(), sides.z()};
  }
  size[static_cast<std::size_t>(traits.radius)] = table.number("radius", Sign::positive);
  if (traits.length[2] != model::no_size)
    size[static_cast<std::size_t>(traits.length[2])] = table.number("length", Sign::positive);
  return size;
}

}  // namespace pbmpi::scenes
