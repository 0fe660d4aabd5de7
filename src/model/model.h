/// The immutable description of one world. Plain data, independent of the engine. SI units; world frame with
/// z up unless a field says otherwise; the pose of a body is that of its centre of mass.
#pragma once

#include <array>
#include <cstdint>
#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "core/vector.h"
#include "model/effect_choices.h"

namespace pbmpi::geometry {
struct TriangleMesh;  // geometry/triangle_mesh.h
}  // namespace pbmpi::geometry

namespace pbmpi::model {

using core::Mat3;
using core::Pose;
using core::Quat;
using core::Vec3;

inline constexpr double infinity = std::numeric_limits<double>::infinity();

/// Stands for the world where a body index is expected: as a joint's second body or a static geom's body.
inline constexpr int no_body = -1;

/// What a body belongs to; decides its colour in the replay.
enum class ActorKind { ground, ramp, wall, car, tank, human, centipede, projectile, prop };
inline constexpr int num_actor_kinds = 9;

/// A thing that the scene placed: a car, a human, one wall.
struct Actor {
  std::string name;  ///< unique in the world, e.g. "car" or "human1"
  ActorKind kind = ActorKind::prop;
  bool self_collision = false;  ///< may two geoms of this actor touch each other?
};

struct Body {
  std::string name;  ///< unique in the world, e.g. "human1.left_thigh"
  int actor = 0;     ///< index into Model::actors
  double mass_kg = 1;
  Mat3 inertia = Mat3::Identity();       ///< [kg m^2], body frame, about the centre of mass
  Pose pose;                             ///< initial
  Vec3 velocity = Vec3::Zero();          ///< initial, of the centre of mass [m/s]
  Vec3 angular_velocity = Vec3::Zero();  ///< initial, world frame [rad/s]
};

/// A mesh is a surface of triangles, which bodies touch from its front; only the static environment has one.
enum class Shape { sphere, box, capsule, cylinder, plane, hull, mesh };
inline constexpr int num_shapes = 7;

/// A convex polyhedron of uniform density, made by geometry/hulls/convex_hull.h; its origin is its centre of
/// mass. Also the faces of a mesh, which need be neither convex nor closed: that has no edges and no mass.
struct Hull {
  /// A flat face: `count` vertices of `corners` from `first` on, counter-clockwise as seen from outside.
  struct Face {
    Vec3 normal = Vec3::UnitZ();  ///< unit, outward
    double height = 0;            ///< [m] of its plane above the origin
    int first = 0, count = 0;
  };
  /// Two vertices, and the two faces that meet between them.
  struct Edge {
    std::array<int, 2> vertices{}, faces{};
  };
  std::vector<Vec3> vertices;  ///< [m]
  std::vector<int> corners;    ///< indices of vertices, face by face
  std::vector<Face> faces;
  std::vector<Edge> edges;
  double volume = 0;                ///< [m^3]
  double surface = 0;               ///< [m^2]
  Mat3 inertia = Mat3::Identity();  ///< [m^5] about the origin, for a density of 1
};

/// The surface of a geom. A pair of geoms has mu = sqrt(mu_a mu_b) and the larger restitution, unless
/// Model::pair_materials says otherwise.
struct Material {
  double mu = 0.5;         ///< Coulomb friction coefficient; 0 = frictionless
  double restitution = 0;  ///< 0 = inelastic, 1 = elastic
};

/// Replaces the material that geoms of two actors would have as a pair.
struct PairMaterial {
  int actor_a = 0, actor_b = 0;  ///< indices into Model::actors, a <= b
  Material material;
};

struct Geom {
  int body = no_body;  ///< no_body: static environment
  int actor = 0;       ///< index into Model::actors
  int space = 0;       ///< index into Model::spaces
  Shape shape = Shape::box;
  /// [m] sphere: radius; box: three full sides; capsule and cylinder: radius, length along z (a capsule's
  /// without its caps); plane: unused; hull, mesh: three full sides of the box about its origin that holds
  /// it.
  std::array<double, 3> size{};
  /// The pose in the body's frame, or in the world frame for a static geom. A plane passes through the
  /// position, and its normal is the local z axis.
  Pose local;
  Material material;
  std::shared_ptr<const Hull> hull =
      nullptr;  ///< with Shape::hull and Shape::mesh; shared by geoms and worlds
  std::shared_ptr<const geometry::TriangleMesh> mesh = nullptr;  ///< with Shape::mesh; `hull` is its surface
};

enum class JointKind { ball, hinge, slider, universal, fixed, hinge2 };
inline constexpr int num_joint_kinds = 6;

/// Range of an angle [rad] or, for a slider, a length [m]; zero is the initial pose. Infinite = free.
struct AxisLimit {
  double low = -infinity;
  double high = infinity;
  bool active() const { return low > -infinity || high < infinity; }
};

/// Drives the axis to `velocity` [rad/s or m/s] with at most `max_force` [N m or N]. A velocity of 0 is dry
/// friction, which creeps under a load that the solver's few iterations do not fully carry; with a
/// `hold_rate` the motor returns to the initial pose.
struct AxisMotor {
  double velocity = 0;
  double max_force = 0;  ///< 0 = no motor
  /// [1/s] Each step aims at velocity - hold_rate x (coordinate of the axis at the step's start), so that a
  /// displacement dies away as exp(-hold_rate t). Above 1 / dt it would overshoot: a step then uses 1 / dt.
  double hold_rate = 0;
  bool active() const { return max_force > 0; }
};

/// hinge2's suspension along axis 1. ODE's ERP = h k / (h k + d), CFM = 1 / (h k + d) for the step h (ODE
/// manual, "How to use ERP and CFM").
struct Spring {
  double stiffness = 0;  ///< k [N/m]; 0 = rigid
  double damping = 0;    ///< d [N s/m]
};

/// A constraint between two bodies; each kind means what it means in ODE (joint_traits.h). Anchors and axes
/// are body-fixed; b's are in the world frame if body_b is no_body.
struct Joint {
  std::string name;
  JointKind kind = JointKind::ball;
  int body_a = 0;
  int body_b = no_body;
  Vec3 anchor_a = Vec3::Zero();  ///< [m], frame of a (unused by slider; fixed uses it for break_torque alone)
  Vec3 anchor_b = Vec3::Zero();  ///< [m], frame of b
  Vec3 axis1_a = Vec3::UnitZ();  ///< unit, frame of a: hinge, slider, universal, hinge2
  Vec3 axis2_b = Vec3::UnitX();  ///< unit, frame of b: universal, hinge2
  std::array<AxisLimit, 2> limits;  ///< of axes 1 and 2 (hinge2: axis 1 only)
  std::array<AxisMotor, 2> motors;  ///< of axis 1 and 2
  /// [kg m^2] or, along a slider's axis, [kg]: inertia that moves with the coordinate of axis 1 or 2 alone,
  /// as that of a motor's rotor behind a gear; its kinetic energy is half of it times the coordinate's speed
  /// squared.
  std::array<double, 2> armature{};
  Spring suspension;        ///< hinge2 only
  double break_force = 0;   ///< [N] above which it breaks (effects/breakage.h); 0 = never
  double break_torque = 0;  ///< [N m] likewise, about the anchor; slider: about its bodies' midpoint

  bool breakable() const { return break_force > 0 || break_torque > 0; }
};

enum class EventKind {
  launch,  ///< sets a body's velocity and angular velocity, and its pose if it has one
  motor,   ///< replaces the motor of a joint's axis
  steer,   ///< pins a joint's axis 1 to an angle (both limits)
  release  ///< breaks a joint, which no longer acts from this step on (effects/breakage.h)
};

/// Something that happens at the start of a step. A motor or steer event holds until the next event of the
/// same axis, so that the joints' settings are a pure function of the step (a restart needs no history).
struct Event {
  std::int64_t step = 0;
  EventKind kind = EventKind::launch;
  int body = no_body;                    ///< launch
  int joint = -1;                        ///< motor, steer, release
  int axis = 0;                          ///< motor: 0 or 1
  Vec3 velocity = Vec3::Zero();          ///< launch [m/s]
  Vec3 angular_velocity = Vec3::Zero();  ///< launch [rad/s]
  std::optional<Pose> pose;              ///< launch: where the body appears, e.g. at a muzzle
  AxisMotor motor;                       ///< motor
  double angle = 0;                      ///< steer [rad]
};

/// How contacts are made. Names and meaning as in ODE's dSurfaceParameters.
struct ContactLaw {
  double soft_erp = 0.2;         ///< share of the penetration removed in a step
  double soft_cfm = 0;           ///< [s/kg]
  double bounce_velocity = 0.1;  ///< slowest approach that bounces [m/s]
  int max_per_pair = 4;          ///< contacts kept for a pair of geoms
};

/// When a resting island falls asleep (effects/sleepers.h). The speed is Box2D's, the time Box2D's and
/// Jolt's.
struct SleepRule {
  double speed = 0.05;         ///< [m/s] highest mean speed over after_s that counts as rest
  double angular_speed = 0.1;  ///< [rad/s] highest mean angular speed that counts as rest
  double after_s = 0.5;        ///< [s] of rest before an island sleeps
};

/// Where a world gets all iterations, and how few are enough elsewhere (effects/field_of_interest.h).
struct Interest {
  Vec3 center = Vec3::Zero();  ///< [m], unless it follows a body
  int follows = no_body;       ///< the body in whose centre of mass it lies
  double radius_m = infinity;  ///< an island with a body within this distance is inside
  int outside_iterations = 4;  ///< of all other islands, unless the run has fewer
};

struct Model {
  std::vector<Actor> actors;
  std::vector<Body> bodies;
  std::vector<Geom> geoms;
  std::vector<Joint> joints;
  std::vector<PairMaterial> pair_materials;  ///< sorted by (a, b), each pair once
  std::vector<std::string> spaces{"world"};  ///< names; Geom::space points here
  bool spaces_meet = true;    ///< false: the author states that bodies of two spaces never touch
  std::vector<Event> events;  ///< sorted by step, stable
  Vec3 gravity{0, 0, -9.81};  ///< [m/s^2]
  double erp = 0.2;           ///< of joints
  double cfm = 1e-10;         ///< of joints [s/kg]
  /// Damping rates d [1/s]: velocities die away as exp(-d t).
  double linear_damping = 0;
  double angular_damping = 0;
  double air_density = 0;  ///< [kg/m^3] of the air that drags on bodies; 0 = none
  ContactLaw contact_law;
  SleepRule sleep;
  std::optional<Interest> interest;  ///< none: the whole world is inside
  EffectChoices effects;             ///< effects demanded or left out, whatever the rest calls for

  int num_bodies() const { return static_cast<int>(bodies.size()); }
  int num_joints() const { return static_cast<int>(joints.size()); }
};

}  // namespace pbmpi::model
