/// A mechanism as trees of links, each of which is placed in its parent and moves by joints: what MJCF and
/// URDF have in common, before it becomes bodies and joints of a Model.
#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "model/model.h"
#include "scenes/parts/mass_properties.h"
#include "scenes/parts/parts.h"

namespace pbmpi::scenes::links {

/// Means the world where a link is expected.
inline constexpr int no_link = -1;

enum class Motion { free, hinge, slide, ball };

/// The forces along a joint's axis other than its limits (drive.h).
struct Drive {
  double friction = 0;   ///< [N m] or [N] dry
  double damping = 0;    ///< [N m s/rad] or [N s/m]: of the joint and of its drives
  double stiffness = 0;  ///< [N m/rad] or [N/m]
  double target = 0;     ///< [rad] or [m] from the pose: rest position of the spring or the servo
  double velocity = 0;   ///< [rad/s] or [m/s] target velocity of a servo
  double most_force = model::infinity;  ///< [N m] or [N] limit of a servo
};

/// Moves a link relative to its parent. Several joints of one link act in their order, starting at the
/// parent; each is described in the link's frame, at the link's pose, from which its limits and its drive
/// count.
struct LinkJoint {
  Motion motion = Motion::hinge;
  std::string name;
  std::string where;           ///< "file:line:column"
  Vec3 anchor = Vec3::Zero();  ///< [m]; hinge and ball
  Vec3 axis = Vec3::UnitZ();   ///< unit; hinge and slide
  model::AxisLimit limit;      ///< [rad] or [m] from the pose
  Drive drive;
  double armature = 0;  ///< [kg m^2] or [kg] inertia that only the hinge or slide moves, e.g. a motor's rotor
  double reference = 0;  ///< [rad] or [m] coordinate at the pose, as the file counts
  double start = 0;      ///< [rad] or [m] from the pose: where a hinge or slide starts
  Quat start_turn;       ///< rotation from the pose with which a ball starts
};

struct LinkGeom {
  model::Shape shape = model::Shape::sphere;
  std::array<double, 3> size{};  ///< as in model::Geom
  Pose pose;                     ///< in the link's frame
  int link = no_link;            ///< set where links become bodies
  double mu = 1;
  unsigned contype = 1, conaffinity = 1;  ///< two geoms may touch if one's type meets the other's affinity
  std::string where;
  std::shared_ptr<const model::Hull> hull = nullptr;  ///< as in model::Geom
  std::shared_ptr<const geometry::TriangleMesh> mesh = nullptr;
};

struct Link {
  std::string name;
  std::string where;
  int parent = no_link;                ///< index of an earlier link
  Pose pose;                           ///< in the parent's frame, before its joints move to their starts
  std::vector<LinkJoint> joints;       ///< none: rigidly part of the parent, or of the world
  std::optional<MassProperties> mass;  ///< in the link's frame
  /// What is wrong with an inertia that no body has, with its place: wrong where what the link is rigidly
  /// part of has none either.
  std::string odd_inertia;
  std::vector<LinkGeom> geoms;
};

/// Holds two links together besides the joints of the tree, as what closes a loop does.
struct Closure {
  std::string name;
  std::string where;
  bool holds_turn = false;  ///< else the two turn about a point, as on a ball joint
  int link = 0, other = 0;  ///< indices of links
  Pose in_link, in_other;   ///< the frames that coincide, or whose origins do, in the frames of the links
};

struct Mechanism {
  std::string name;
  std::vector<Link> links;
  std::vector<Closure> closures;
  /// Pairs of links whose geoms never touch, in addition to those that a joint connects.
  std::vector<std::pair<int, int>> apart;
  bool self_collision = true;  ///< may geoms of different links touch at all?
  bool joins_massless =
      false;  ///< do links without mass become part of others, where that changes no motion?
};

/// What a model file of another simulator describes.
struct ModelFile {
  Mechanism mechanism;
  std::optional<Vec3> gravity;  ///< [m/s^2]
  std::optional<double> dt_s;   ///< the step that the file proposes
};

}  // namespace pbmpi::scenes::links
