#include "scenes/format/shape_reader.h"

#include <string>
#include <vector>

#include "core/text.h"
#include "model/shape_traits.h"

namespace pbmpi::scenes {

model::Shape read_shape(TableReader& table, std::span<const model::Shape> allowed) {
  const std::string name = table.text("shape");
  std::vector<std::string> names;
  for (const model::Shape shape : allowed) {
    names.emplace_back(model::traits_of(shape).name);
    if (names.back() == name) return shape;
  }
  table.fail("shape", "unknown shape " + core::in_quotes(name) + core::suggestion(name, names));
}

std::array<double, 3> read_size(TableReader& table, model::Shape shape) {
  if (shape == model::Shape::box) {
    const core::Vec3 size = table.vector("size", Sign::positive);
    return {size.x(), size.y(), size.z()};
  }
  std::array<double, 3> size = {table.number("radius", Sign::positive)};
  if (shape != model::Shape::sphere) size[1] = table.number("length", Sign::positive);
  return size;
}

}  // namespace pbmpi::scenes
