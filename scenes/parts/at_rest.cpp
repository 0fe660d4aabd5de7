#include "scenes/parts/at_rest.h"

#include <algorithm>
#include <vector>

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

/// Heights of all level planes, ascending.
std::vector<double> level_grounds(const model::Model& model) {
  std::vector<double> heights;
  for (const model::Geom& geom : model.geoms) {
    const bool is_level = geom.local.direction_to_outer(Vec3::UnitZ()).z() > 1 - 1e-9;  // rounding
    if (geom.shape == model::Shape::plane && is_level) heights.push_back(geom.local.position.z());
  }
  std::ranges::sort(heights);
  return heights;
}

/// [num_bodies] How far each body extends below its centre.
std::vector<double> reaches_down(const model::Model& model) {
  std::vector<double> reaches(model.bodies.size(), 0.0);
  for (const model::Geom& geom : model.geoms) {
    if (geom.body == model::no_body) continue;
    const model::BodyPose at = to_body_pose(model.bodies[geom.body].pose);
    const model::BodyPose pose = geometry::geom_pose(geom, at);
    const double below = at.position[2] - pose.position[2];
    double& reach = reaches[geom.body];
    reach = std::max(reach, below + geometry::half_extent(geom, pose.rotation, -Vec3::UnitZ()));
  }
  return reaches;
}

}  // namespace

void bring_to_rest(model::Model& model) {
  model.events.clear();
  const std::vector<double> grounds = level_grounds(model), reaches = reaches_down(model);
  for (int i = 0; i < model.num_bodies(); ++i) {
    model::Body& body = model.bodies[i];
    const bool flies =
        model.actors[body.actor].kind == model::ActorKind::projectile && !body.velocity.isZero();
    const auto above = std::ranges::upper_bound(grounds, body.pose.position.z());
    if (flies && above != grounds.begin())
      body.pose.position.z() = *(above - 1) + reaches[i] - initial_depth_m;
    body.velocity.setZero();
    body.angular_velocity.setZero();
  }
  for (model::Joint& joint : model.joints) {
    for (model::AxisMotor& motor : joint.motors) motor.velocity = 0;
  }
}

}  // namespace pbmpi::scenes
