#include "scenes/links/joint_chain.h"

#include <algorithm>
#include <cmath>

#include <Eigen/Eigenvalues>

namespace pbmpi::scenes::links {
namespace {

using model::JointKind;
using model::Mat3;

constexpr double rounding = 1e-6;  // of a user's digits: [m], and for the cosine of a right angle

JointKind kind_of(Motion motion) {
  if (motion == Motion::slide) return JointKind::slider;
  return motion == Motion::ball ? JointKind::ball : JointKind::hinge;
}

bool turn_about_one_point(const LinkJoint& a, const LinkJoint& b) {
  return a.motion == Motion::hinge && b.motion == Motion::hinge && (a.anchor - b.anchor).norm() <= rounding;
}

bool make_a_universal(const LinkJoint& a, const LinkJoint& b) {
  return turn_about_one_point(a, b) && std::abs(a.axis.dot(b.axis)) <= rounding;
}

std::vector<ChainPiece> pieces_of(const std::vector<LinkJoint>& joints) {
  std::vector<ChainPiece> pieces;
  for (std::size_t end = joints.size(); end > 0;) {  // from the link outwards
    if (end > 1 && make_a_universal(joints[end - 2], joints[end - 1])) {
      pieces.push_back({JointKind::universal, {joints[end - 2], joints[end - 1]}});
      end -= 2;
    } else {
      pieces.push_back({kind_of(joints[end - 1].motion), {joints[end - 1]}});
      end -= 1;
    }
  }
  std::ranges::reverse(pieces);
  return pieces;
}

/// Splits a body of mass m at distance d from the point: the part s m moves into the point, and the rest
/// moves out to d / (1 - s). This keeps mass and centre, and costs the inertia s / (1 - s) m d^2.
void split_about(const Vec3& point, std::size_t count, JointChain& chain) {
  const Vec3 arm = chain.rest.centre - point;
  const double mass = chain.rest.mass_kg;
  constexpr double most_loss = 0.25;  // of any moment
  const Eigen::GeneralizedSelfAdjointEigenSolver<Mat3> losses(steiner(mass, arm), chain.rest.inertia,
                                                              Eigen::EigenvaluesOnly);
  const double most = most_loss / std::max(losses.eigenvalues().maxCoeff(), most_loss);
  const double share = std::min(share_between, most / (1 + most) / static_cast<double>(count));
  const double all = share * static_cast<double>(count);
  const double turning = (chain.rest.inertia + steiner(mass, arm)).trace() / 3;
  chain.rest.inertia -= steiner(all / (1 - all) * mass, arm);
  chain.rest.mass_kg = (1 - all) * mass;
  chain.rest.centre = point + arm / (1 - all);
  chain.between.assign(count, {share * mass, point, share_between * turning * Mat3::Identity()});
}

void split_evenly(std::size_t count, JointChain& chain) {
  const double share = std::min(share_between, 0.5 / static_cast<double>(count));
  const MassProperties whole = chain.rest;
  chain.between.assign(count, {share * whole.mass_kg, whole.centre, share * whole.inertia});
  const double rest = 1 - share * static_cast<double>(count);
  chain.rest.mass_kg *= rest;
  chain.rest.inertia *= rest;
}

}  // namespace

JointChain chain_of(const Rigid& rigid) {
  JointChain chain;
  chain.rest = rigid.mass;
  if (rigid.joints.empty() || rigid.joints.front().motion == Motion::free) return chain;
  chain.pieces = pieces_of(rigid.joints);
  const std::size_t num_between = chain.pieces.size() - 1;
  if (num_between > 0) {
    const LinkJoint& first = rigid.joints.front();
    chain.is_gimbal = std::ranges::all_of(
        rigid.joints, [&](const LinkJoint& joint) { return turn_about_one_point(first, joint); });
    chain.is_gimbal ? split_about(first.anchor, num_between, chain) : split_evenly(num_between, chain);
  }
  return chain;
}

}  // namespace pbmpi::scenes::links
