/// Along which axis two convex solids overlap least, or are farthest apart.
#pragma once

#include <algorithm>

#include "model/model.h"

namespace pbmpi::geometry {

/// Chooses among axes by the rules for boxes (solver/collide/box_lanes.h): a face wins unless two edges
/// overlap less by more than 5 % and a share of the contact margin; the gap of edges counts 5 % less.
class LeastOverlap {
 public:
  enum class Kind { none, face_of_a, face_of_b, edges };

  explicit LeastOverlap(double margin_m) : margin_(margin_m) {}

  /// `gap` [m]: between the solids along `normal`, which points into a; negative: they overlap.
  void add_face(Kind kind, double gap, const core::Vec3& normal, int face) {
    widest_ = std::max(widest_, gap);
    if (gap > gap_) take(kind, gap, normal, face, 0);
  }
  void add_edges(double gap, const core::Vec3& normal, int edge_a, int edge_b) {
    constexpr double share_of_margin = 0.25;
    widest_ = std::max(widest_, gap);
    const double rated = std::min(1.05 * gap, 0.95 * gap);
    edges_by_ = std::max(edges_by_, rated);
    const double lead = kind_ == Kind::edges ? 0 : share_of_margin * margin_;
    if (rated - lead > gap_) take(Kind::edges, gap, normal, edge_a, edge_b);
  }

  bool apart() const { return widest_ > margin_; }
  Kind kind() const { return kind_; }
  const core::Vec3& normal() const { return normal_; }  ///< unit, into a
  int first() const { return first_; }                  ///< the face, or the edge of a
  int second() const { return second_; }                ///< the edge of b
  /// [m] Depth of two edges, or the upper bound of a face's points.
  double depth() const { return kind_ == Kind::edges ? -gap_ : -edges_by_; }
  double gap() const { return gap_; }  ///< [m] the widest so far, as chosen

 private:
  void take(Kind kind, double gap, const core::Vec3& normal, int first, int second) {
    kind_ = kind;
    gap_ = gap;
    normal_ = normal;
    first_ = first;
    second_ = second;
  }

  double margin_;
  Kind kind_ = Kind::none;
  double gap_ = -model::infinity, widest_ = -model::infinity, edges_by_ = -model::infinity;
  core::Vec3 normal_ = core::Vec3::Zero();
  int first_ = 0, second_ = 0;
};

}  // namespace pbmpi::geometry
