/// MJCF's `<compiler>` and `<option>`: how to read the rest of the file, and settings of the world.
#pragma once

#include <optional>
#include <string>

#include "scenes/parts/parts.h"
#include "scenes/xml/attributes.h"
#include "scenes/xml/notes.h"

namespace pbmpi::scenes::mjcf {

enum class InertiaFrom { geoms_if_none, geoms, inertial };

struct Compiler {
  bool in_degrees = true;
  std::string euler_sequence = "xyz";  ///< lower case: about the axes as turned so far
  bool autolimits = true;
  InertiaFrom inertia_from = InertiaFrom::geoms_if_none;
  int first_inertia_group = 0, last_inertia_group = 5;  ///< groups of geoms whose mass counts
  double least_mass = 0, least_inertia = 0;
  bool balances_inertia = false;  ///< if a moment exceeds the sum of the others, all three become their mean
  std::optional<double> total_mass;  ///< [kg] to which all masses are scaled

  double angle(double value) const { return in_degrees ? radians(value) : value; }
  /// Reads `limited` of a joint or an actuator, which may have a range or not.
  bool is_limited(xml::Attributes& attributes, std::string_view limited, std::string_view range) const;
  /// The force that such a range allows in either direction; infinite without one.
  double most_force(xml::Attributes& attributes, std::string_view limited, std::string_view range,
                    xml::Notes& notes) const;
};

struct Option {
  double timestep_s = 0.002;
  Vec3 gravity{0, 0, -9.81};  ///< [m/s^2]
  bool collides = true;
  bool has_limits = true;
  bool has_actuators = true;
  bool has_equality = true;
  bool has_friction = true;  ///< of joints
  bool has_springs = true, has_dampers = true;
  bool clips_controls = true;  ///< to the ranges of their actuators
};

/// Reads the element; later elements of one kind complete earlier ones.
void read_compiler(const xml::Element& element, const xml::LeaveOut& leave_out, Compiler& compiler);
void read_option(const xml::Element& element, const xml::LeaveOut& leave_out, Option& option);

/// Reads the position and the orientation of an element in the frame around it: `pos`, and one of `quat`,
/// `axisangle`, `euler`, `xyaxes`, `zaxis`.
Pose read_pose(xml::Attributes& attributes, const Compiler& compiler);

/// The rotation by three angles, in the unit and the sequence of the file.
Quat turn_by_euler(const Vec3& angles, const Compiler& compiler);

/// The smallest rotation of the z axis into a direction, which need not have unit length.
Quat turn_of_z(const Vec3& direction);

}  // namespace pbmpi::scenes::mjcf
