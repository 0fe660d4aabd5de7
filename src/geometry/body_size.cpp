#include "geometry/body_size.h"

#include <algorithm>

#include "geometry/geometry.h"

namespace pbmpi::geometry {

std::vector<double> sizes_of(const model::Model& model) {
  std::vector<double> sizes(model.bodies.size(), 0);
  for (const model::Geom& geom : model.geoms) {
    if (geom.body == model::no_body || geom.shape == model::Shape::plane) continue;
    const double radius = geom.local.position.norm() + bounding_radius(geom);
    sizes[geom.body] = std::max(sizes[geom.body], 2 * radius);
  }
  return sizes;
}

}  // namespace pbmpi::geometry
