// A standing human: 16 segments, 15 joints, muscles that hold the pose.
#include "scenes/actors/human_skeleton.h"

#include <cmath>
#include <numbers>
#include <string>

#include "core/elementary.h"
#include "scenes/actors/actor_builder.h"

namespace pbmpi::scenes {
namespace {

using model::JointKind;
using model::Shape;

struct Human {
  double mass_kg = 75;
  double height_m = 1.75;
  double stance_deg = 0;             ///< of the legs from the vertical, the left one forward
  double tone = 1;                   ///< share of the greatest voluntary torque that holds each joint
  model::Material material{0.6, 0};  ///< cloth and leather on road or steel
};

// Breadth to depth of the trunk (chest 0.32 m to 0.21 m in men).
constexpr double trunk_aspect = 1.5;
// [1/s] Rate at which muscles undo a displacement, within 20 ms: dry friction alone creeps, since 20
// iterations do not carry the whole weight, and a standing man falls within 2 s. Half of what a step of 0.01
// s can undo.
constexpr double hold_rate = 50;
// Breadth of the hand over its thickness, 0.085 m to 0.028 m.
constexpr double hand_aspect = 3;

/// Builds in the actor's frame: x forward, y left, z up, origin between the ankles on the ground. All
/// segments start upright, their axes parallel to the actor's.
class HumanBuilder : ActorBuilder {
 public:
  HumanBuilder(const Human& human, const Placement& place, model::Model& model)
      : ActorBuilder(place, model::ActorKind::human, model), human_(human), skeleton_(human.height_m) {}

  void build() {
    const Skeleton& s = skeleton_;
    const int pelvis = add_upright(lower_trunk, "", 0, s.navel, s.hip);
    const int belly = add_upright(middle_trunk, "", 0, s.xiphoid, s.navel);
    const int chest = add_upright(upper_trunk, "", 0, s.neck, s.xiphoid);
    const int skull = add_upright(head, "", 0, s.vertex, s.neck);
    const Vec3 forward_bend = Vec3::UnitY();
    const Vec3 left_tilt = -Vec3::UnitX();
    add_universal("lumbar", pelvis, belly, point(0, s.navel), forward_bend, trunk_bend, left_tilt,
                  trunk_tilt);
    // The ribcage leaves the upper spine little play.
    add_joint("thoracic", JointKind::fixed, belly, chest, point(0, s.xiphoid));
    add_universal("neck", chest, skull, point(0, s.neck), forward_bend, neck_bend, left_tilt, neck_tilt);
    for (const int side : {1, -1}) {
      add_arm(chest, side);
      add_leg(pelvis, side);
    }
  }

 private:
  static std::string side_name(int side) { return side > 0 ? "left_" : "right_"; }

  /// A point of the upright upper body at this height of the skeleton.
  Vec3 point(double y, double height) const { return {0, y, height - hip_drop()}; }

  void add_arm(int chest, int side) {
    const Skeleton& s = skeleton_;
    const std::string name = side_name(side);
    const double y = side * half_shoulder_breadth * human_.height_m;
    const int upper = add_upright(upper_arm, name, y, s.shoulder, s.elbow);
    const int lower = add_upright(forearm, name, y, s.elbow, s.wrist);
    const int palm = add_hand(name, y);
    // Segments that hang below their joint bend forward by a turn about -y. The palm faces the thigh: it
    // bends inwards, and the thumb points forward.
    add_joint(name + "shoulder", JointKind::ball, chest, upper, point(y, s.shoulder));
    add_hinge(name + "elbow", upper, lower, point(y, s.elbow), -Vec3::UnitY(), elbow_bend);
    add_universal(name + "wrist", lower, palm, point(y, s.wrist), -side * Vec3::UnitX(), wrist_bend,
                  -Vec3::UnitY(), wrist_tilt);
  }

  /// Both legs are straight; the left one is swung forward by the stance angle, the right one backward, and
  /// the feet are flat on the ground.
  void add_leg(int pelvis, int side) {
    const Skeleton& s = skeleton_;
    const std::string name = side_name(side);
    const double swing_deg = side * human_.stance_deg;
    const Quat swing = rotation(radians(swing_deg), -Vec3::UnitY());
    const Pose hip{{0, side * half_hip_distance * human_.height_m, s.hip - hip_drop()}, swing};
    const Vec3 knee = hip.point_to_outer({0, 0, s.knee - s.hip});
    const Vec3 ankle = hip.point_to_outer({0, 0, s.ankle - s.hip});
    const int upper = add_limb(thigh, name, hip, s.hip - s.knee);
    const int lower = add_limb(shank, name, {knee, swing}, s.knee - s.ankle);
    const int sole = add_foot(name, ankle);
    add_universal(name + "hip", pelvis, upper, hip.position, -Vec3::UnitY(), hip_bend.from(swing_deg),
                  hip.direction_to_outer(side * Vec3::UnitX()), hip_tilt);
    add_hinge(name + "knee", upper, lower, knee, Vec3::UnitY(), knee_bend);
    // The feet are stiff, as in boots. An ankle held by a motor would have to carry the whole body through a
    // foot of 1 kg: QuickStep's 20 iterations transmit so little of such a torque that a standing man falls
    // within 1.5 s, whatever the torque (with 1000 iterations he stands).
    add_joint(name + "ankle", JointKind::fixed, lower, sole, ankle);
  }

  /// How far the stance lowers the hips.
  double hip_drop() const {
    return (skeleton_.hip - skeleton_.ankle) * (1 - core::cosine(radians(human_.stance_deg)));
  }

  /// An upright segment between two heights.
  int add_upright(const Segment& segment, const std::string& side, double y, double top, double bottom) {
    return add_limb(segment, side, {{0, y, top - hip_drop()}, {}}, top - bottom);
  }

  /// A segment that reaches from the origin of `top` down along its z axis: a box for the trunk, or a capsule
  /// that ends at the endpoints.
  int add_limb(const Segment& segment, const std::string& side, const Pose& top, double length) {
    const double mass = segment.mass_fraction * human_.mass_kg;
    const double com = segment.com_fraction * length;
    const int body =
        add_segment(segment, side, {top.point_to_outer({0, 0, -com}), top.orientation}, length, 2);
    const double section = mass / (tissue_density_kg_m3 * length);
    const Pose middle{{0, 0, com - length / 2}, {}};
    if (&segment == &lower_trunk || &segment == &middle_trunk || &segment == &upper_trunk) {
      const double depth = std::sqrt(section / trunk_aspect);
      add_geom(body, Shape::box, {depth, trunk_aspect * depth, length}, middle);
    } else {
      const double radius = std::sqrt(section / std::numbers::pi);
      add_geom(body, Shape::capsule, {radius, length - 2 * radius, 0}, middle);
    }
    return body;
  }

  /// The whole hand with fingers stretched downwards, which is longer than de Leva's wrist to knuckle.
  int add_hand(const std::string& side, double y) {
    const double knuckle = hand.length_m * skeleton_.scale;
    const double com = skeleton_.wrist - hip_drop() - hand.com_fraction * knuckle;
    const int body = add_segment(hand, side, {{0, y, com}, {}}, knuckle, 2);
    const double length = hand_length * human_.height_m;
    const double section = hand.mass_fraction * human_.mass_kg / (tissue_density_kg_m3 * length);
    const double thickness = std::sqrt(section / hand_aspect);
    add_geom(body, Shape::box, {hand_aspect * thickness, thickness, length},
             {{0, 0, skeleton_.wrist - hip_drop() - length / 2 - com}, {}});
    return body;
  }

  int add_foot(const std::string& side, const Vec3& ankle) {
    const double length = foot.length_m * skeleton_.scale;
    const double heel = ankle.x() - ankle_from_heel * length;
    const double height = skeleton_.ankle;
    const double com = heel + foot.com_fraction * length;
    const int body = add_segment(foot, side, {{com, ankle.y(), height / 2}, {}}, length, 0);
    add_geom(body, Shape::box, {length, foot_breadth * human_.height_m, height},
             {{heel + length / 2 - com, 0, 0}, {}});
    return body;
  }

  int add_segment(const Segment& segment, const std::string& side, const Pose& pose, double length,
                  int longitudinal) {
    const double mass = segment.mass_fraction * human_.mass_kg;
    return add_part(side + std::string(segment.name), mass,
                    segment_inertia(segment, mass, length, longitudinal),
                    compose(place_.pose, {pose.position - Vec3(0, 0, initial_depth_m), pose.orientation}));
  }

  void add_geom(int body, Shape shape, const std::array<double, 3>& size, const Pose& local) {
    ActorBuilder::add_geom(body, shape, size, local, human_.material);
  }

  model::Joint& add_joint(const std::string& name, JointKind kind, int inner, int outer, const Vec3& anchor,
                          const Vec3& axis1 = Vec3::UnitY(), const Vec3& axis2 = Vec3::UnitX()) {
    // ODE measures an angle as the first body against the second; the outer segment's turn has the opposite
    // sign, hence the minus.
    return ActorBuilder::add_joint(name, kind, inner, outer, at(anchor - Vec3(0, 0, initial_depth_m)),
                                   -along(axis1), -along(axis2));
  }

  void add_hinge(const std::string& name, int inner, int outer, const Vec3& anchor, const Vec3& axis,
                 const Motion& motion) {
    set_motion(add_joint(name, JointKind::hinge, inner, outer, anchor, axis), 0, motion);
  }

  void add_universal(const std::string& name, int inner, int outer, const Vec3& anchor, const Vec3& axis1,
                     const Motion& motion1, const Vec3& axis2, const Motion& motion2) {
    model::Joint& joint = add_joint(name, JointKind::universal, inner, outer, anchor, axis1, axis2);
    set_motion(joint, 0, motion1);
    set_motion(joint, 1, motion2);
  }

  void set_motion(model::Joint& joint, int axis, const Motion& motion) const {
    joint.limits[axis] = {radians(motion.low_deg), radians(motion.high_deg)};
    joint.motors[axis] = {0, human_.tone * motion.torque_nm, hold_rate};
  }

  const Human& human_;
  Skeleton skeleton_;
};

}  // namespace

ActorPlan read_human(TableReader& actor, const SceneContext&) {
  Human human;
  human.mass_kg = actor.number("mass", Sign::positive, human.mass_kg);
  human.height_m = actor.number("height", Sign::positive, human.height_m);
  human.stance_deg = actor.number("stance", Sign::non_negative, human.stance_deg);
  // With a larger angle the rear foot, flat on the ground, would bend the ankle beyond its range.
  if (human.stance_deg > ankle_dorsiflexion_deg) actor.fail("stance", "'stance' must lie in 0 to 20 degrees");
  human.tone = actor.number("tone", Sign::non_negative, human.tone);
  human.material = read_material(actor, human.material);
  // The cross-sections of the limbs follow from the mass: outside these proportions a limb would be wider
  // than long.
  const double body_mass_index = human.mass_kg / (human.height_m * human.height_m);
  if (body_mass_index < 10 || body_mass_index > 60) {
    actor.fail("mass", "mass and height do not make a human (mass / height^2 must lie in 10 to 60 kg/m^2)");
  }
  return [human](const Placement& place, model::Model& model) { HumanBuilder(human, place, model).build(); };
}

}  // namespace pbmpi::scenes
