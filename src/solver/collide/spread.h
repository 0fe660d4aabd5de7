/// Which points of a manifold are far from each other.
#pragma once

namespace pbmpi::solver {

/// Among points in a plane, finds the one farthest from a first point, and the farthest on either side of the
/// line between these two. Together with the first, these span nearly the area of all. A class template of T,
/// so that each instruction set has its own code.
template <class T>
struct Spread {
  using Scalar = typename T::Scalar;
  struct Place {
    Scalar x, y;
  };

  int farthest = 0, left = 0, right = 0;
  Scalar square = 0;  ///< [m^2] squared distance of the farthest
  /// [m^2] Twice the area of the triangle with the point on that side, negative on the right; 0: there is
  /// none.
  Scalar area_left = 0, area_right = 0;

  /// place(i): the place of the i-th of `count` points.
  template <class GetPlace>
  static Spread from(int first, int count, GetPlace place) {
    Spread spread;
    const Place origin = place(first);
    for (int i = 0; i < count; ++i) {
      const Place at = place(i);
      const Scalar dx = at.x - origin.x, dy = at.y - origin.y;
      if (dx * dx + dy * dy > spread.square) {
        spread.square = dx * dx + dy * dy;
        spread.farthest = i;
      }
    }
    const Place far = place(spread.farthest);
    const Scalar lx = far.x - origin.x, ly = far.y - origin.y;
    for (int i = 0; i < count; ++i) {
      const Place at = place(i);
      const Scalar area = lx * (at.y - origin.y) - ly * (at.x - origin.x);
      if (area > spread.area_left) {
        spread.area_left = area;
        spread.left = i;
      }
      if (area < spread.area_right) {
        spread.area_right = area;
        spread.right = i;
      }
    }
    return spread;
  }
};

}  // namespace pbmpi::solver
