/// The bodies and geoms of each space, for tests of boxes that need not be tight.
#pragma once

#include <span>
#include <vector>

#include "geometry/box.h"
#include "model/contact.h"
#include "model/space_map.h"

namespace pbmpi::solver {

class SpaceBodies {
 public:
  SpaceBodies(const model::Model& model, const model::SpaceMap& map, double margin_m = 0);

  /// [m] by which boxes of geoms are to be enlarged, so that boxes of geoms that may have a contact overlap.
  double margin_m() const { return margin_m_; }
  std::span<const int> bodies(int space) const { return bodies_of_space_[space]; }  ///< with a geom
  std::span<const int> geoms(int body) const { return geoms_of_body_[body]; }
  /// The box around a ball about the body's centre of mass that holds its geoms and the margin: wider than
  /// their boxes by up to the body's own size, at a tenth of their cost.
  geometry::Box ball_box(int body, const model::BodyPose& pose) const;
  /// Holds the ball boxes of a space's bodies, and hence the boxes of its geoms. `poses` [num_bodies]
  geometry::Box space_box(int space, std::span<const model::BodyPose> poses) const;

 private:
  double margin_m_;
  std::vector<std::vector<int>> bodies_of_space_;
  std::vector<std::vector<int>> geoms_of_body_;
  std::vector<double> radius_;  ///< [num_bodies] m
};

}  // namespace pbmpi::solver
