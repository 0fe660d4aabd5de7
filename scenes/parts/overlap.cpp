#include "scenes/parts/overlap.h"

#include <algorithm>
#include <cmath>
#include <set>
#include <vector>

#include "geometry/box_tree.h"
#include "geometry/geometry.h"
#include "scenes/parts/parts.h"

namespace pbmpi::scenes {
namespace {

using model::Shape;
using ActorPair = std::pair<int, int>;

/// A box inside a geom, world frame.
struct InnerBox {
  int actor = 0;
  bool is_static = false;
  Vec3 centre;
  model::Mat3 axes;  ///< columns
  Vec3 half;
  geometry::Box hull;  ///< aligned with the world's axes
};

/// The share to which the box about a hull shrinks so as to lie inside of it.
double share_inside(const model::Hull& hull, const geometry::Extent& box) {
  double share = 1;
  for (const model::Hull::Face& face : hull.faces)
    share = std::min(share, face.height / face.normal.cwiseAbs().dot(Vec3(box.half.data())));
  return share;
}

/// Half sides of a box inside the geom, in the geom's own frame: a radius reaches equally far along the axes
/// on which the shape has no length.
Vec3 inner_half_sides(const model::Geom& geom) {
  const geometry::Extent extent = geometry::extent_of(geom);
  if (geom.shape == Shape::hull) return share_inside(*geom.hull, extent) * Vec3(extent.half.data());
  const auto round = std::ranges::count(extent.half, 0.0);
  const double reach = round == 0 ? 0 : (extent.ball + extent.disc) / std::sqrt(static_cast<double>(round));
  const auto half = [&](std::size_t k) { return extent.half[k] > 0 ? extent.half[k] : reach; };
  return {half(0), half(1), half(2)};
}

Pose pose_of(const model::Geom& geom, const model::Model& model) {
  return geom.body == model::no_body ? geom.local : compose(model.bodies[geom.body].pose, geom.local);
}

InnerBox inner_box(const model::Geom& geom, const model::Model& model) {
  const Pose pose = pose_of(geom, model);
  InnerBox box;
  box.actor = geom.actor;
  box.is_static = geom.body == model::no_body;
  box.centre = pose.position;
  box.axes = pose.orientation.to_eigen().toRotationMatrix();
  box.half = inner_half_sides(geom);
  const Vec3 reach = box.axes.cwiseAbs() * box.half;
  for (int k = 0; k < 3; ++k) {
    const auto at = static_cast<std::size_t>(k);
    box.hull.min[at] = box.centre[k] - reach[k];
    box.hull.max[at] = box.centre[k] + reach[k];
  }
  return box;
}

double reach_along(const InnerBox& box, const Vec3& direction) {
  return (box.axes.transpose() * direction).cwiseAbs().dot(box.half);
}

/// Smallest overlap over the separating axes of two boxes (Gottschalk, Lin, Manocha, "OBBTree", SIGGRAPH
/// 1996); at most 0 if they are apart.
double depth(const InnerBox& a, const InnerBox& b) {
  const Vec3 between = b.centre - a.centre;
  double least = model::infinity;
  const auto try_axis = [&](const Vec3& axis) {
    const double length = axis.norm();
    if (length < 1e-6) return;  // parallel edges: the faces' axes suffice
    const Vec3 unit = axis / length;
    least = std::min(least, reach_along(a, unit) + reach_along(b, unit) - std::abs(between.dot(unit)));
  };
  for (int i = 0; i < 3; ++i) {
    try_axis(a.axes.col(i));
    try_axis(b.axes.col(i));
    for (int j = 0; j < 3; ++j) try_axis(a.axes.col(i).cross(b.axes.col(j)));
  }
  return least;
}

double depth_in_plane(const InnerBox& box, const Pose& plane) {
  const Vec3 normal = plane.direction_to_outer(Vec3::UnitZ());
  return reach_along(box, normal) - normal.dot(box.centre - plane.position);
}

/// Pairs of actors that a joint connects, which may overlap: a door in its frame.
std::set<ActorPair> joined_actors(const model::Model& model) {
  std::set<ActorPair> pairs;
  for (const model::Joint& joint : model.joints) {
    if (joint.body_b == model::no_body) continue;
    pairs.insert(std::minmax(model.bodies[joint.body_a].actor, model.bodies[joint.body_b].actor));
  }
  return pairs;
}

class Search {
 public:
  Search(const model::Model& model, std::optional<double> tolerance_m)
      : model_(&model), tolerance_m_(tolerance_m), joined_(joined_actors(model)) {
    for (const model::Geom& geom : model.geoms) {
      const bool is_solid = geom.shape != Shape::plane && geom.shape != Shape::mesh;
      if (is_solid) boxes_.push_back(inner_box(geom, model));
    }
    std::sort(boxes_.begin(), boxes_.end(),
              [](const InnerBox& a, const InnerBox& b) { return a.hull.min[0] < b.hull.min[0]; });
  }

  std::optional<Overlap> run() const {
    for (const model::Geom& geom : model_->geoms) {
      if (geom.shape != Shape::plane) continue;
      for (const InnerBox& box : boxes_) {
        if (box.is_static || geom.actor == box.actor) continue;
        const double deep = depth_in_plane(box, pose_of(geom, *model_));
        if (deep > tolerance(box)) return overlap(geom.actor, box.actor, deep);
      }
    }
    return among_boxes();
  }

 private:
  /// The pair that a sweep along x meets first.
  std::optional<Overlap> among_boxes() const {
    std::vector<geometry::Box> hulls;
    hulls.reserve(boxes_.size());
    for (const InnerBox& box : boxes_) hulls.push_back(box.hull);
    geometry::BoxTree tree;
    tree.set(hulls);
    std::optional<std::pair<std::size_t, std::size_t>> first;
    double depth_of_first = 0;
    for (std::size_t i = 0; i < boxes_.size(); ++i) {
      tree.for_each_near(hulls[i], [&](int other) {
        const std::pair pair(i, static_cast<std::size_t>(other));
        if (pair.second <= i || (first && *first <= pair)) return;
        const InnerBox &a = boxes_[pair.first], &b = boxes_[pair.second];
        if (!may_clash(a, b)) return;
        const double deep = depth(a, b);
        if (!(deep > std::min(tolerance(a), tolerance(b)))) return;
        first = pair;
        depth_of_first = deep;
      });
    }
    if (!first) return std::nullopt;
    return overlap(boxes_[first->first].actor, boxes_[first->second].actor, depth_of_first);
  }

  bool may_clash(const InnerBox& a, const InnerBox& b) const {
    if (a.actor == b.actor || (a.is_static && b.is_static)) return false;
    return !joined_.contains(std::minmax(a.actor, b.actor));
  }

  double tolerance(const InnerBox& box) const {
    return tolerance_m_.value_or(
        std::min(overlap_tolerance_m, overlap_tolerance_share * 2 * box.half.minCoeff()));
  }

  static Overlap overlap(int a, int b, double deep) { return {std::min(a, b), std::max(a, b), deep}; }

  const model::Model* model_;
  std::optional<double> tolerance_m_;
  std::set<ActorPair> joined_;
  std::vector<InnerBox> boxes_;
};

}  // namespace

std::optional<Overlap> find_overlap(const model::Model& model, std::optional<double> tolerance_m) {
  return Search(model, tolerance_m).run();
}

}  // namespace pbmpi::scenes
