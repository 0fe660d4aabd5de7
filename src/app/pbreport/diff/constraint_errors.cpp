#include "app/pbreport/diff/constraint_errors.h"

#include <algorithm>
#include <cstdlib>

#include "model/joint_gap.h"

namespace pbmpi::app {
namespace {

using core::Pose;
using core::Vec3;

struct JointViolations {
  std::vector<double> gap_m, bend_rad;
  std::int64_t broken = 0;
};

Pose pose_of(const analysis::PoseView& poses, int body) {
  if (body == model::no_body) return {};
  return {poses.position[static_cast<std::size_t>(body)], poses.orientation[static_cast<std::size_t>(body)]};
}

void add_joints(const RunModels& models, const RecordedPoses& recorded, JointViolations& found) {
  for (std::size_t world = 0; world < models.worlds.size(); ++world) {
    const model::Model& model = *models.worlds[world];
    const analysis::PoseView poses = recorded.world(models, world);
    for (std::size_t i = 0; i < model.joints.size(); ++i) {
      if (!poses.holds(i)) {
        ++found.broken;
        continue;
      }
      const model::Joint& joint = model.joints[i];
      const Vec3 gap = model::joint_gap_vector_in_a(model, joint, pose_of(poses, joint.body_a),
                                                    pose_of(poses, joint.body_b));
      found.gap_m.push_back(gap.norm());
      found.bend_rad.push_back(analysis::joint_axis_angle(model, joint, poses));
    }
  }
}

/// Velocity of a body's point.
Vec3 velocity_at(const io::RecordedContacts& frame, const std::vector<Vec3>& centres, std::int64_t body,
                 const Vec3& point) {
  if (body < 0) return Vec3::Zero();
  const auto i = static_cast<std::size_t>(body);
  return frame.velocity[i] + frame.angular_velocity[i].cross(point - centres[i]);
}

/// A pyramid holds more than this along its diagonal: what it calls sliding may still stick, not the reverse.
bool should_stick(const io::ContactRow& contact) {
  constexpr double nearly = 0.99;
  return contact.normal_force > 0 && contact.friction.norm() < nearly * contact.mu * contact.normal_force;
}

void add_contacts(const io::RecordedContacts& frame, const std::vector<Vec3>& centres, double dt_s,
                  std::vector<double>& depth_m, std::vector<double>& slip_m) {
  for (const io::ContactRow& contact : frame.contacts) {
    depth_m.push_back(std::max(contact.depth_m, 0.0));
    if (!should_stick(contact)) continue;
    const Vec3 speed = velocity_at(frame, centres, contact.body_a, contact.position) -
                       velocity_at(frame, centres, contact.body_b, contact.position);
    slip_m.push_back(dt_s * (speed - contact.normal * contact.normal.dot(speed)).norm());
  }
}

}  // namespace

ConstraintErrors constraint_errors(const RunModels& models, const io::RunData& run, const std::string& path) {
  JointViolations joints;
  std::vector<double> depth_m, slip_m;
  const double dt_s = std::strtod(run.parameters.at("dt").c_str(), nullptr);
  const io::ContactReader contacts(path);
  for (const std::size_t row : measured_rows(run, run.position.size())) {
    add_joints(models, {&run.position[row], &run.orientation[row], broken_at(models, run, row)}, joints);
    if (contacts.has_any()) add_contacts(contacts.read(row), run.position[row], dt_s, depth_m, slip_m);
  }
  ConstraintErrors errors;
  errors.joint_gap = analysis::summarize_positions(joints.gap_m);
  errors.joint_bend = analysis::summarize_orientations(joints.bend_rad);
  for (analysis::ErrorSummary* summary : {&errors.joint_gap, &errors.joint_bend}) {
    summary->broken = joints.broken;
    summary->count += joints.broken;
  }
  if (contacts.has_any()) {
    errors.penetration = analysis::summarize_positions(depth_m);
    errors.slip = analysis::summarize_positions(slip_m);
  }
  if (const auto found = run.num_events.find(stepping::event_kind::passage); found != run.num_events.end())
    errors.passages = found->second;
  return errors;
}

}  // namespace pbmpi::app
