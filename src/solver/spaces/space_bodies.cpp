#include "solver/spaces/space_bodies.h"

#include <algorithm>
#include <cmath>

#include "geometry/geometry.h"

namespace pbmpi::solver {

using geometry::Box;

SpaceBodies::SpaceBodies(const model::Model& model, const model::SpaceMap& map, double margin_m)
    : margin_m_(margin_m),
      bodies_of_space_(static_cast<std::size_t>(map.num_spaces())),
      geoms_of_body_(model.bodies.size()),
      radius_(model.bodies.size(), 0) {
  for (std::size_t i = 0; i < model.geoms.size(); ++i) {
    const model::Geom& geom = model.geoms[i];
    if (geom.body == model::no_body) continue;
    geoms_of_body_[geom.body].push_back(static_cast<int>(i));
    const double radius = geom.local.position.norm() + geometry::bounding_radius(geom);
    radius_[geom.body] = std::max(radius_[geom.body], radius);
  }
  for (int body = 0; body < model.num_bodies(); ++body) {
    if (!geoms_of_body_[body].empty()) bodies_of_space_[map.space_of_body(body)].push_back(body);
  }
}

Box SpaceBodies::ball_box(int body, const model::BodyPose& pose) const {
  Box box;
  for (std::size_t k = 0; k < 3; ++k) {
    // Wider than the box of any geom in it, whose slack is 1e-6 of its coordinates.
    const double reach = radius_[body] + margin_m_ + 2e-6 * (std::abs(pose.position[k]) + 2 * radius_[body]);
    box.min[k] = pose.position[k] - reach;
    box.max[k] = pose.position[k] + reach;
  }
  return box;
}

Box SpaceBodies::space_box(int space, std::span<const model::BodyPose> poses) const {
  Box box;
  for (const int body : bodies_of_space_[space]) box.include(ball_box(body, poses[body]));
  return box;
}

}  // namespace pbmpi::solver
