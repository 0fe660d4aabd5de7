#include "geometry/principal_axes.h"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <array>
#include <cmath>

namespace pbmpi::geometry {

using model::Mat3;
using model::Vec3;

namespace {

/// How far the ratio of two moments is from 1.
double difference(double a, double b) { return std::max(a, b) / std::min(a, b); }

/// The axis whose moment is to come last: that which leaves the two most alike.
int odd_axis(const Vec3& moments) {
  const std::array<double, 3> left = {difference(moments.y(), moments.z()),
                                      difference(moments.z(), moments.x()),
                                      difference(moments.x(), moments.y())};
  return static_cast<int>(std::ranges::min_element(left) - left.begin());
}

}  // namespace

PrincipalAxes principal_axes(const Mat3& inertia) {
  Mat3 axes = Mat3::Identity();
  Vec3 moments = inertia.diagonal();
  if (!inertia.isDiagonal(0)) {  // a body whose frame is principal keeps its axes to the bit
    const Eigen::SelfAdjointEigenSolver<Mat3> solver(inertia);
    axes = solver.eigenvectors();
    if (axes.determinant() < 0) axes.col(0) *= -1;
    moments = solver.eigenvalues();
  }
  const int last = odd_axis(moments), first = (last + 1) % 3, second = (last + 2) % 3;
  Mat3 turned;
  turned << axes.col(first), axes.col(second), axes.col(last);
  return {model::Quat::from_eigen(Eigen::Quaterniond(turned)),
          {moments[first], moments[second], moments[last]}};
}

}  // namespace pbmpi::geometry
