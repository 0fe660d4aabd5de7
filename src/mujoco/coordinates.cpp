#include "mujoco/coordinates.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "mujoco/mjcf.h"

namespace pbmpi::mujoco {
namespace {

using Eigen::Quaterniond;
using model::Pose;
using model::Quat;
using model::Vec3;

/// A frame and its motion.
struct Moving {
  Pose pose;
  Vec3 velocity = Vec3::Zero();          ///< of its origin [m/s]
  Vec3 angular_velocity = Vec3::Zero();  ///< [rad/s], world frame

  Vec3 velocity_at(const Vec3& point) const {
    return velocity + angular_velocity.cross(point - pose.position);
  }
};

Moving moving(const model::State& state, int body) {
  if (body == model::no_body) return {};
  return {
      {state.position[body], state.orientation[body]}, state.velocity[body], state.angular_velocity[body]};
}

/// Angle [rad] about the unit vector `axis` that takes `from` to `to`, from their components perpendicular to
/// it.
double angle_about(const Vec3& axis, const Vec3& from, const Vec3& to) {
  const Vec3 a = from - axis * axis.dot(from), b = to - axis * axis.dot(to);
  return std::atan2(axis.dot(a.cross(b)), a.dot(b));
}

/// Angle [rad] of a rotation about the unit vector `axis`, within half a turn.
double twist(const Quaterniond& turn, const Vec3& axis) {
  const double sign = turn.w() < 0 ? -1 : 1;
  return 2 * std::atan2(sign * axis.dot(turn.vec()), sign * turn.w());
}

std::vector<const LinkAxis*> hinges_of(const Link& link) {
  std::vector<const LinkAxis*> hinges;
  for (const LinkAxis& axis : link.axes) {
    if (axis.freedom == Freedom::hinge) hinges.push_back(&axis);
  }
  return hinges;
}

/// Angles [rad] of one or two hinges; the first is the one nearer to the parent. `turn`: that of the child,
/// in its frame at zero, R(first) R(second), which takes axis 2 to where the first angle alone puts it.
std::array<double, 2> hinge_angles(const std::vector<const LinkAxis*>& hinges, const Quaterniond& turn) {
  if (hinges.size() == 1) return {twist(turn, hinges[0]->direction), 0};
  const Vec3 &first = hinges[0]->direction, &second = hinges[1]->direction;
  return {angle_about(first, second, turn * second), -angle_about(second, first, turn.conjugate() * first)};
}

/// Speeds [rad/s] about one or two unit axes that best fit the angular velocity.
std::array<double, 2> hinge_speeds(const std::array<Vec3, 2>& axes, std::size_t count, const Vec3& velocity) {
  const double along0 = axes[0].dot(velocity);
  if (count == 1) return {along0, 0};
  const double along1 = axes[1].dot(velocity), cosine = axes[0].dot(axes[1]);
  const double scale = 1 / (1 - cosine * cosine);
  return {scale * (along0 - cosine * along1), scale * (along1 - cosine * along0)};
}

/// How far and how fast a child has slid: between the anchors, or, without anchors, from its pose in the
/// parent at zero.
struct Slide {
  double way = 0, speed = 0;
};

Slide slide_of(const Link& link, const Vec3& axis, const Moving& parent, const Moving& child) {
  const Vec3 from = parent.pose.point_to_outer(link.has_anchor ? link.anchor_parent : link.zero.position);
  const Vec3 to = link.has_anchor ? child.pose.point_to_outer(link.anchor_child) : child.pose.position;
  return {axis.dot(to - from), axis.dot(child.velocity_at(to) - parent.velocity_at(from))};
}

void put(const Vec3& v, mjtNum* to) { std::copy_n(v.data(), 3, to); }

void put_turn(const Quaterniond& q, mjtNum* to) {
  to[0] = q.w();
  to[1] = q.x();
  to[2] = q.y();
  to[3] = q.z();
}

void put_free(const Moving& body, mjtNum* qpos, mjtNum* qvel) {
  put(body.pose.position, qpos);
  put_turn(body.pose.orientation.to_eigen(), qpos + 3);
  put(body.velocity, qvel);
  put(body.pose.orientation.to_eigen().conjugate() * body.angular_velocity, qvel + 3);
}

void put_link(const Link& link, const Moving& parent, const Moving& child, mjtNum* qpos, mjtNum* qvel) {
  const Quaterniond zero = parent.pose.orientation.to_eigen() * link.zero.orientation.to_eigen();
  const Quaterniond now = child.pose.orientation.to_eigen();
  const Quaterniond turn = zero.conjugate() * now;
  const Vec3 spin = child.angular_velocity - parent.angular_velocity;
  if (link.axes.size() == 1 && link.axes[0].freedom == Freedom::ball) {
    put_turn(turn, qpos);
    put(now.conjugate() * spin, qvel);
    return;
  }
  const std::vector<const LinkAxis*> hinges = hinges_of(link);
  std::array<double, 2> angles{}, speeds{};
  if (!hinges.empty()) {
    angles = hinge_angles(hinges, turn);
    const std::array<Vec3, 2> axes = {zero * hinges.front()->direction, now * hinges.back()->direction};
    speeds = hinge_speeds(axes, hinges.size(), spin);
  }
  std::size_t hinge = 0;
  for (std::size_t k = 0; k < link.axes.size(); ++k) {
    const LinkAxis& axis = link.axes[k];
    if (axis.freedom == Freedom::hinge) {
      qpos[k] = angles[hinge];
      qvel[k] = speeds[hinge++];
    } else {  // the first axis is fixed in the parent, the last in the child
      const Slide slide = slide_of(link, (k == 0 ? zero : now) * axis.direction, parent, child);
      qpos[k] = slide.way;
      qvel[k] = slide.speed;
    }
  }
}

}  // namespace

Coordinates::Coordinates(const std::vector<Link>& links, const mjModel& compiled)
    : links_(&links), bodies_(compiled.nbody, model::no_body) {
  for (int body = 0; body < static_cast<int>(links.size()); ++body) {
    const int id = mj_name2id(&compiled, mjOBJ_BODY, body_name(body).c_str());
    ids_.push_back(id);
    bodies_[id] = body;
    const int axis = compiled.body_jntadr[id];  // -1: none
    first_axis_.push_back(axis);
    qpos_.push_back(axis < 0 ? 0 : compiled.jnt_qposadr[axis]);
    qvel_.push_back(axis < 0 ? 0 : compiled.jnt_dofadr[axis]);
  }
}

void Coordinates::to_mujoco(const model::State& state, mjData& data) const {
  for (int body = 0; body < static_cast<int>(links_->size()); ++body) {
    const Link& link = (*links_)[body];
    mjtNum *qpos = data.qpos + qpos_[body], *qvel = data.qvel + qvel_[body];
    if (link.is_free())
      put_free(moving(state, body), qpos, qvel);
    else if (!link.axes.empty())
      put_link(link, moving(state, link.hold.parent), moving(state, body), qpos, qvel);
  }
}

void Coordinates::to_state(const mjModel& compiled, mjData& data, model::State& state) const {
  mj_kinematics(&compiled, &data);
  mj_comPos(&compiled, &data);
  mj_comVel(&compiled, &data);
  for (int body = 0; body < static_cast<int>(links_->size()); ++body) {
    const int id = ids_[body];
    const mjtNum* q = data.xquat + 4 * id;
    std::array<mjtNum, 6> velocity;  // angular, then linear; world frame
    mj_objectVelocity(&compiled, &data, mjOBJ_XBODY, id, velocity.data(), 0);
    state.position[body] = Vec3(data.xpos + 3 * id);
    state.orientation[body] = {q[0], q[1], q[2], q[3]};
    state.angular_velocity[body] = Vec3(velocity.data());
    state.velocity[body] = Vec3(velocity.data() + 3);
  }
}

}  // namespace pbmpi::mujoco
