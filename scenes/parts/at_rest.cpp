#include "scenes/parts/at_rest.h"

#include <algorithm>
#include <optional>

#include "geometry/geometry.h"
#include "scenes/parts/parts.h"

namespace pbmpi::scenes {
namespace {

// A contact needs some depth to exist; actors start with the same depth.
constexpr double initial_depth_m = 1e-4;

model::BodyPose to_body_pose(const Pose& pose) {
  model::BodyPose result{};
  for (int i = 0; i < 3; ++i) result.position[i] = pose.position[i];
  const Quat& q = pose.orientation;
  geometry::to_rotation(q.w, q.x, q.y, q.z, result.rotation);
  return result;
}

/// Height of the highest level plane below a point.
std::optional<double> ground_below(const model::Model& model, double height_m) {
  std::optional<double> ground;
  for (const model::Geom& geom : model.geoms) {
    const bool is_level = geom.local.direction_to_outer(Vec3::UnitZ()).z() > 1 - 1e-9;  // rounding
    if (geom.shape != model::Shape::plane || !is_level) continue;
    const double height = geom.local.position.z();
    if (height <= height_m) ground = std::max(ground.value_or(height), height);
  }
  return ground;
}

/// How far the body extends below its centre.
double reach_down(const model::Model& model, int body) {
  const model::BodyPose at = to_body_pose(model.bodies[body].pose);
  double reach = 0;
  for (const model::Geom& geom : model.geoms) {
    if (geom.body != body) continue;
    const model::BodyPose pose = geometry::geom_pose(geom, at);
    const double below = at.position[2] - pose.position[2];
    reach = std::max(reach, below + geometry::half_extent(geom, pose.rotation, -Vec3::UnitZ()));
  }
  return reach;
}

}  // namespace

model::Model at_rest(model::Model model) {
  model.events.clear();
  for (int i = 0; i < model.num_bodies(); ++i) {
    model::Body& body = model.bodies[i];
    const bool flies =
        model.actors[body.actor].kind == model::ActorKind::projectile && !body.velocity.isZero();
    const auto ground = flies ? ground_below(model, body.pose.position.z()) : std::nullopt;
    if (ground) body.pose.position.z() = *ground + reach_down(model, i) - initial_depth_m;
    body.velocity.setZero();
    body.angular_velocity.setZero();
  }
  for (model::Joint& joint : model.joints) {
    for (model::AxisMotor& motor : joint.motors) motor.velocity = 0;
  }
  return model;
}

}  // namespace pbmpi::scenes
