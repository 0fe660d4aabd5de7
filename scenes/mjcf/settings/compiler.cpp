#include "scenes/mjcf/settings/compiler.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "core/elementary.h"
#include "core/text.h"

namespace pbmpi::scenes::mjcf {
namespace {

using xml::Attributes;
using xml::Range;

Vec3 axis_of(char letter) {
  const int index = (letter | 0x20) - 'x';
  Vec3 axis = Vec3::Zero();
  axis[index] = 1;
  return axis;
}

std::string read_euler_sequence(Attributes& compiler) {
  std::string sequence = compiler.text("eulerseq", "xyz");
  if (sequence.size() != 3 || sequence.find_first_not_of("xyzXYZ") != std::string::npos)
    compiler.fail("eulerseq", "'eulerseq' must be three of x, y, z, X, Y, Z");
  return sequence;
}

Quat read_axis_angle(Attributes& element, const Compiler& compiler) {
  const std::vector<double> values = element.numbers("axisangle", 4, 4);
  const Vec3 axis(values[0], values[1], values[2]);
  if (!(axis.norm() > 0)) element.fail("axisangle", "the axis of 'axisangle' is zero and has no direction");
  return rotation(compiler.angle(values[3]), axis.normalized());
}

Quat read_xy_axes(Attributes& element) {
  const std::vector<double> values = element.numbers("xyaxes", 6, 6);
  const Vec3 x(values[0], values[1], values[2]), y(values[3], values[4], values[5]);
  const Vec3 along = x.normalized(), across = y - y.dot(along) * along;
  if (!(x.norm() > 0) || !(across.norm() > 1e-9 * y.norm()))
    element.fail("xyaxes", "the axes of 'xyaxes' are zero or parallel; give two that are not");
  model::Mat3 axes;
  axes << along, across.normalized(), along.cross(across.normalized());
  return Quat::from_eigen(Eigen::Quaterniond(axes).normalized());
}

void read_flags(const xml::Element& element, const xml::LeaveOut& leave_out, Option& option) {
  Attributes flags(element, leave_out);
  const auto is_on = [&](std::string_view name) {
    return flags.word(name, {"enable", "disable"}, "enable") == "enable";
  };
  const bool constrains = is_on("constraint"), is_passive = is_on("passive");
  option.collides = is_on("contact") && constrains && option.collides;
  option.has_limits = is_on("limit") && constrains && option.has_limits;
  option.has_equality = is_on("equality") && constrains && option.has_equality;
  option.has_friction = is_on("frictionloss") && constrains && option.has_friction;
  option.has_springs = is_on("spring") && is_passive && option.has_springs;
  option.has_dampers = is_on("damper") && is_passive && option.has_dampers;
  option.has_actuators = is_on("actuation") && option.has_actuators;
  option.clips_controls = is_on("clampctrl") && option.clips_controls;
  if (!is_on("gravity")) option.gravity = Vec3::Zero();
  if (!is_on("filterparent"))
    flags.fail_unless_left_out("filterparent",
                               "bodies that a joint connects never touch here; enable 'filterparent'");
  flags.allow({"warmstart", "refsafe", "sensor", "midphase", "eulerdamp", "nativeccd", "autoreset", "island",
               "sleep", "override", "energy", "fwdinv", "invdiscrete", "sensornoise", "multiccd"});
  flags.finish();
}

}  // namespace

bool Compiler::is_limited(Attributes& attributes, std::string_view limited, std::string_view range) const {
  const std::string word = attributes.word(limited, {"true", "false", "auto"}, "auto");
  const bool has_range = attributes.has(range);
  if (word == "true" && !has_range)
    attributes.fail(limited, core::in_quotes(limited) + " needs a " + core::in_quotes(range));
  return has_range && (word == "true" || (word == "auto" && autolimits));
}

double Compiler::most_force(Attributes& attributes, std::string_view limited, std::string_view range,
                            xml::Notes& notes) const {
  if (!is_limited(attributes, limited, range)) return model::infinity;
  const std::vector<double> forces = attributes.numbers(range, 2, 2);
  if (forces[0] != -forces[1])
    notes.add(attributes.where(range),
              "a " + core::in_quotes(range) + " that is not even: the larger force holds both ways");
  return std::max(std::abs(forces[0]), std::abs(forces[1]));
}

void read_compiler(const xml::Element& element, const xml::LeaveOut& leave_out, Compiler& compiler) {
  Attributes from(element, leave_out);
  if (from.has("angle")) compiler.in_degrees = from.word("angle", {"degree", "radian"}, "degree") == "degree";
  if (from.has("eulerseq")) compiler.euler_sequence = read_euler_sequence(from);
  compiler.autolimits = from.flag("autolimits", compiler.autolimits);
  if (from.has("inertiafromgeom")) {
    const std::string word = from.word("inertiafromgeom", {"true", "false", "auto"}, "auto");
    compiler.inertia_from = word == "auto"   ? InertiaFrom::geoms_if_none
                            : word == "true" ? InertiaFrom::geoms
                                             : InertiaFrom::inertial;
  }
  if (const auto groups = from.numbers("inertiagrouprange", 2, 2); !groups.empty()) {
    compiler.first_inertia_group = static_cast<int>(std::clamp(groups[0], -1e6, 1e6));
    compiler.last_inertia_group = static_cast<int>(std::clamp(groups[1], -1e6, 1e6));
  }
  compiler.least_mass = from.number("boundmass", Range::non_negative, compiler.least_mass);
  compiler.least_inertia = from.number("boundinertia", Range::non_negative, compiler.least_inertia);
  compiler.balances_inertia = from.flag("balanceinertia", compiler.balances_inertia);
  if (from.number("settotalmass", Range::any, -1.0) > 0) compiler.total_mass = from.number("settotalmass");
  from.word("coordinate", {"local"}, "local");
  if (from.word("conflict", {"warning", "merge", "error"}, "warning") != "warning")
    from.fail_unless_left_out("conflict", "the main model's settings always win; take 'conflict' out");
  from.allow({"meshdir", "texturedir", "assetdir", "strippath", "fitaabb", "discardvisual", "usethread",
              "convexhull", "fusestatic", "exactmeshinertia", "alignfree", "saveinertial"});
  from.finish();
}

void read_option(const xml::Element& element, const xml::LeaveOut& leave_out, Option& option) {
  Attributes from(element, leave_out);
  option.timestep_s = from.number("timestep", Range::positive, option.timestep_s);
  option.gravity = from.vector("gravity", option.gravity);
  for (const char* name : {"density", "viscosity"}) {
    if (from.number(name, Range::any, 0.0) != 0)
      from.fail_unless_left_out(
          name, "a medium has no equal here; in a TOML scene, [air] has a density; take it out");
  }
  from.word("collision", {"all"}, "all");
  if (from.has("o_margin") || from.has("o_solref") || from.has("o_solimp") || from.has("o_friction"))
    leave_out.notes().add(from.where(), "contacts that are overridden here (o_...) are those of the geoms");
  from.allow({"wind",
              "magnetic",
              "impratio",
              "apirate",
              "o_margin",
              "o_solref",
              "o_solimp",
              "o_friction",
              "integrator",
              "cone",
              "jacobian",
              "solver",
              "iterations",
              "tolerance",
              "ls_iterations",
              "ls_tolerance",
              "noslip_iterations",
              "noslip_tolerance",
              "ccd_iterations",
              "ccd_tolerance",
              "mpr_iterations",
              "mpr_tolerance",
              "sdf_iterations",
              "sdf_initpoints",
              "sleep_tolerance",
              "actuatorgroupdisable"});
  from.finish();
  for (const xml::Element& child : element.children) {
    if (child.name == "flag") {
      read_flags(child, leave_out, option);
    } else if (!leave_out.drops(child.name, child.where)) {
      xml::refuse_element(child, "unknown element; <option> has only <flag>; take it out");
    }
  }
}

Pose read_pose(Attributes& element, const Compiler& compiler) {
  Pose pose;
  pose.position = element.vector("pos", Vec3(Vec3::Zero()));
  std::string_view given;
  for (const std::string_view name : {"quat", "axisangle", "euler", "xyaxes", "zaxis"}) {
    if (!element.has(name)) continue;
    if (!given.empty())
      element.fail(name, core::in_quotes(given) + " and " + core::in_quotes(name) +
                             " both give the orientation; leave out one");
    given = name;
  }
  if (given == "quat") pose.orientation = element.turn("quat");
  if (given == "axisangle") pose.orientation = read_axis_angle(element, compiler);
  if (given == "euler") pose.orientation = turn_by_euler(element.vector("euler"), compiler);
  if (given == "xyaxes") pose.orientation = read_xy_axes(element);
  if (given == "zaxis") pose.orientation = turn_of_z(element.direction("zaxis", Vec3::UnitZ()));
  return pose;
}

Quat turn_by_euler(const Vec3& angles, const Compiler& compiler) {
  Eigen::Quaterniond q = Eigen::Quaterniond::Identity();
  for (int i = 0; i < 3; ++i) {
    const char letter = compiler.euler_sequence[static_cast<std::size_t>(i)];
    const Eigen::Quaterniond turn = rotation(compiler.angle(angles[i]), axis_of(letter)).to_eigen();
    q = letter >= 'x' ? q * turn : turn * q;
  }
  return Quat::from_eigen(q.normalized());
}

Quat turn_of_z(const Vec3& direction) {
  const Vec3 to = direction.normalized();
  const Eigen::Quaterniond q(1 + to.z(), -to.y(), to.x(), 0);  // halfway between no turn and twice the turn
  constexpr double opposite = 1e-10;
  if (q.norm() < opposite) return {0, 1, 0, 0};
  return Quat::from_eigen(q.normalized());
}

}  // namespace pbmpi::scenes::mjcf
