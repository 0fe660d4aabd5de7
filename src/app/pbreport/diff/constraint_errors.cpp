#include "app/pbreport/diff/constraint_errors.h"

#include <algorithm>
#include <cstdlib>
#include <set>

#include "app/pbreport/diff/actors.h"

namespace pbmpi::app {
namespace {

using core::Vec3;

/// Errors of some joints and contacts.
struct Violations {
  std::vector<double> gap_m, bend_rad, depth_m, slip_m;
  std::int64_t broken = 0;

  void append(const Violations& more) {
    const auto add = [](std::vector<double>& to, const std::vector<double>& from) {
      to.insert(to.end(), from.begin(), from.end());
    };
    add(gap_m, more.gap_m);
    add(bend_rad, more.bend_rad);
    add(depth_m, more.depth_m);
    add(slip_m, more.slip_m);
    broken += more.broken;
  }
};

/// One frame, by actors; contacts between two actors count for both, and once in `all`.
struct FrameViolations {
  Violations all;
  std::vector<Violations> by_actor;
};

void add_joints(const RunModels& models, const RecordedPoses& recorded,
                const std::vector<std::size_t>& actor_of_joint, FrameViolations& found) {
  for (std::size_t world = 0; world < models.worlds.size(); ++world) {
    const model::Model& model = *models.worlds[world];
    const analysis::PoseView poses = recorded.world(models, world);
    for (std::size_t i = 0; i < model.joints.size(); ++i) {
      Violations& of_actor = found.by_actor[actor_of_joint[models.first_joint[world] + i]];
      if (!poses.holds(i)) {
        ++found.all.broken;
        ++of_actor.broken;
        continue;
      }
      const model::Joint& joint = model.joints[i];
      const double gap_m = analysis::joint_gap_vector_in_a(model, joint, poses).norm();
      const double bend_rad = analysis::joint_axis_angle(model, joint, poses);
      for (Violations* all : {&found.all, &of_actor}) {
        all->gap_m.push_back(gap_m);
        all->bend_rad.push_back(bend_rad);
      }
    }
  }
}

/// Velocity of a point of a body.
Vec3 velocity_at(const io::RecordedContacts& frame, const std::vector<Vec3>& centres, std::int64_t body,
                 const Vec3& point) {
  if (body < 0) return Vec3::Zero();
  const auto i = static_cast<std::size_t>(body);
  return frame.velocity[i] + frame.angular_velocity[i].cross(point - centres[i]);
}

/// A pyramid holds more than this along its diagonal: a contact that slides by this test may still stick, not
/// the reverse.
bool should_stick(const io::ContactRow& contact) {
  constexpr double nearly = 0.99;
  return contact.normal_force > 0 && contact.friction.norm() < nearly * contact.mu * contact.normal_force;
}

/// Displacement [m] of a slipping contact in a step.
double slip_of(const io::RecordedContacts& frame, const std::vector<Vec3>& centres,
               const io::ContactRow& contact, double dt_s) {
  const Vec3 speed = velocity_at(frame, centres, contact.body_a, contact.position) -
                     velocity_at(frame, centres, contact.body_b, contact.position);
  return dt_s * (speed - contact.normal * contact.normal.dot(speed)).norm();
}

void add_contacts(const io::RecordedContacts& frame, const std::vector<Vec3>& centres, double dt_s,
                  const std::vector<std::size_t>& actor_of_body, FrameViolations& found) {
  for (const io::ContactRow& contact : frame.contacts) {
    std::vector<Violations*> concerned = {&found.all};
    const std::size_t actor_a = actor_of_body.at(static_cast<std::size_t>(contact.body_a));
    concerned.push_back(&found.by_actor[actor_a]);
    if (contact.body_b >= 0) {
      const std::size_t actor_b = actor_of_body.at(static_cast<std::size_t>(contact.body_b));
      if (actor_b != actor_a) concerned.push_back(&found.by_actor[actor_b]);
    }
    for (Violations* all : concerned) all->depth_m.push_back(std::max(contact.depth_m, 0.0));
    if (!should_stick(contact)) continue;
    const double slip_m = slip_of(frame, centres, contact, dt_s);
    for (Violations* all : concerned) all->slip_m.push_back(slip_m);
  }
}

ConstraintErrors summarize(const Violations& found, bool has_contacts) {
  ConstraintErrors errors;
  errors.joint_gap = analysis::summarize_positions(found.gap_m);
  errors.joint_bend = analysis::summarize_orientations(found.bend_rad);
  for (analysis::ErrorSummary* summary : {&errors.joint_gap, &errors.joint_bend}) {
    summary->broken = found.broken;
    summary->count += found.broken;
  }
  if (has_contacts) {
    errors.penetration = analysis::summarize_positions(found.depth_m);
    errors.slip = analysis::summarize_positions(found.slip_m);
  }
  return errors;
}

}  // namespace

RunConstraints constraint_errors(const RunModels& models, const io::RunData& run, const std::string& path,
                                 const std::vector<std::size_t>& rows) {
  const RecordedActors actors = actors_of(run.bodies);
  std::vector<std::size_t> actor_of_joint;
  for (const std::size_t body : bodies_of_joints(models)) actor_of_joint.push_back(actors.of_body[body]);
  const double dt_s = std::strtod(run.parameters.at("dt").c_str(), nullptr);
  const io::ContactReader contacts(path);
  const std::vector<std::size_t> measured = measured_rows(run, run.position.size());
  std::set<std::size_t> wanted(measured.begin(), measured.end());
  wanted.insert(rows.begin(), rows.end());

  RunConstraints result;
  FrameViolations all{{}, std::vector<Violations>(actors.list.size())};
  for (const std::size_t row : wanted) {
    FrameViolations frame{{}, std::vector<Violations>(actors.list.size())};
    add_joints(models, {&run.position[row], &run.orientation[row], broken_at(models, run, row)},
               actor_of_joint, frame);
    if (contacts.has_any()) add_contacts(contacts.read(row), run.position[row], dt_s, actors.of_body, frame);
    if (std::ranges::binary_search(rows, row))
      result.by_frame.push_back(summarize(frame.all, contacts.has_any()));
    if (!std::ranges::binary_search(measured, row)) continue;
    all.all.append(frame.all);
    for (std::size_t i = 0; i < all.by_actor.size(); ++i) all.by_actor[i].append(frame.by_actor[i]);
  }
  result.all = summarize(all.all, contacts.has_any());
  for (const Violations& actor : all.by_actor)
    result.by_actor.push_back(summarize(actor, contacts.has_any()));
  if (const auto found = run.num_events.find(stepping::event_kind::passage); found != run.num_events.end())
    result.all.passages = found->second;
  return result;
}

}  // namespace pbmpi::app
