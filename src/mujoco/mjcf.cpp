#include "mujoco/mjcf.h"

#include <algorithm>
#include <cmath>
#include <initializer_list>
#include <map>
#include <set>
#include <stdexcept>
#include <utility>

#include "core/text.h"
#include "effects/effects.h"
#include "model/shape_traits.h"

namespace pbmpi::mujoco {
namespace {

/// Impedance of motors, limits and loops: the share of the desired acceleration that a row gets, 0 to 0.9999.
/// The remainder yields to the load.
constexpr double stiff_impedance = 0.999;
/// Impedance of contacts: MuJoCo's default, from touching to 1 mm of depth. With 0.98 Newton's solver took
/// four times as many iterations, each as expensive, for the walls of CrashWa, which rested no better.
constexpr const char* contact_impedance = "0.9 0.95 0.001";

std::string numbers(std::initializer_list<double> values) {
  std::string text;
  for (const double value : values) text += (text.empty() ? "" : " ") + core::number_text(value);
  return text;
}

std::string numbers(const model::Vec3& v) { return numbers({v.x(), v.y(), v.z()}); }

std::string attribute(const char* name, const std::string& value) {
  return std::string(" ") + name + "='" + value + "'";
}

std::string place(const model::Pose& pose) {
  const model::Quat& q = pose.orientation;
  return attribute("pos", numbers(pose.position)) + attribute("quat", numbers({q.w, q.x, q.y, q.z}));
}

/// The spring of MuJoCo's rows, a = -B v - K r with K = 1 / (T z)^2 and B = 2 / T up to the impedance,
/// removes the share `erp` of an error r in a step of length h, as ODE's rows do, with T = 2 h and z = 1 / (2
/// sqrt(erp)).
std::string spring(double dt_s, double erp) {
  constexpr double least_erp = 1e-6;
  return numbers({2 * dt_s, 0.5 / std::sqrt(std::max(erp, least_erp))});
}

std::string impedance(double share) { return numbers({share, share, 0.001}); }

/// MuJoCo takes a radius and half of each length; the size of a plane only affects how it is drawn.
std::string size_of(const model::Geom& geom) {
  const model::ShapeTraits& traits = model::traits_of(geom.shape);
  if (traits.num_sizes == 0) return "0 0 1";
  std::string text;
  for (int i = 0; i < traits.num_sizes; ++i) {
    const double size = geom.size[static_cast<std::size_t>(i)];
    text += (i == 0 ? "" : " ") + numbers({i == traits.radius ? size : size / 2});
  }
  return text;
}

class Writer {
 public:
  Writer(const MjcfParts& parts, int stack)
      : parts_(parts),
        stack_(stack),
        children_(parts.model.bodies.size() + 1),
        geoms_(parts.model.bodies.size() + 1) {
    const model::Model& model = parts.model;
    for (int body = 0; body < model.num_bodies(); ++body)
      children_[slot(parts.links[body].hold.parent)].push_back(body);
    for (std::size_t geom = 0; geom < model.geoms.size(); ++geom)
      geoms_[slot(model.geoms[geom].body)].push_back(static_cast<int>(geom));
  }

  std::string write() {
    text_ = "<mujoco><compiler angle='radian' inertiafromgeom='false'/>";
    write_options();
    write_meshes();
    text_ += "<worldbody>";
    write_inside(model::no_body);
    text_ += "</worldbody>";
    write_excludes();
    write_constraints();
    return text_ + "</mujoco>";
  }

 private:
  static std::size_t slot(int body) { return static_cast<std::size_t>(body + 1); }

  void write_options() {
    const model::Model& model = parts_.model;
    const double dt_s = parts_.settings.dt_s;
    const effects::StepPlan plan(model);
    const bool collides = plan.has(effects::EffectId::collision);
    text_ += "<option integrator='implicit' cone='elliptic' jacobian='auto'" + attribute("solver", "Newton") +
             attribute("timestep", numbers({dt_s})) + attribute("gravity", numbers(model.gravity)) +
             attribute("iterations", std::to_string(parts_.settings.iterations)) +
             "><flag constraint='disable' warmstart='disable' filterparent='disable'" +
             attribute("contact", collides ? "enable" : "disable") + "/></option>";
    // Almost no room, and no constraints, for the trial step that MuJoCo makes with the model: see Engine.
    text_ += "<size njmax='1' nconmax='1'" + attribute("nstack", std::to_string(stack_)) + "/>";
    const std::string joints = spring(dt_s, model.erp), stiff = impedance(stiff_impedance);
    text_ += "<default><joint" + attribute("solreflimit", joints) + attribute("solimplimit", stiff) +
             attribute("solreffriction", joints) + attribute("solimpfriction", stiff) + "/><geom condim='3'" +
             attribute("solref", spring(dt_s, model.contact_law.soft_erp)) +
             attribute("solimp", contact_impedance) + "/><equality" + attribute("solref", joints) +
             attribute("solimp", stiff) + "/></default>";
  }

  /// One mesh for all geoms that share a hull. MuJoCo finds its faces, and moves the geom's frame to its
  /// centre of mass and principal axes, which moves no point of it.
  void write_meshes() {
    std::string meshes;
    for (const model::Geom& geom : parts_.model.geoms) {
      if (geom.shape != model::Shape::hull || !meshes_.emplace(geom.hull.get(), meshes_.size()).second)
        continue;
      std::string vertices;
      for (const model::Vec3& vertex : geom.hull->vertices) vertices += numbers(vertex) + " ";
      meshes += "<mesh" + attribute("name", mesh_name(*geom.hull)) + attribute("vertex", vertices) + "/>";
    }
    if (!meshes.empty()) text_ += "<asset>" + meshes + "</asset>";
  }

  std::string mesh_name(const model::Hull& hull) const { return "m" + std::to_string(meshes_.at(&hull)); }

  void write_inside(int body) {
    for (const int geom : geoms_[slot(body)]) write_geom(geom);
    for (const int child : children_[slot(body)]) write_body(child);
  }

  void write_body(int body) {
    const Link& link = parts_.links[body];
    text_ += "<body" + attribute("name", body_name(body)) + place(link.zero) + ">";
    if (link.is_free()) text_ += "<freejoint" + attribute("name", axis_name(body, 0)) + "/>";
    for (std::size_t k = 0; k < link.axes.size(); ++k) write_axis(body, link, k);
    write_inertia(parts_.model.bodies[body]);
    write_inside(body);
    text_ += "</body>";
  }

  void write_axis(int body, const Link& link, std::size_t k) {
    const LinkAxis& axis = link.axes[k];
    const char* type = axis.freedom == Freedom::ball    ? "ball"
                       : axis.freedom == Freedom::hinge ? "hinge"
                                                        : "slide";
    text_ += "<joint" + attribute("name", axis_name(body, k)) + attribute("type", type) +
             attribute("pos", numbers(link.anchor_child)) + attribute("axis", numbers(axis.direction));
    const double armature =
        link.hold.joint < 0 || axis.is_suspension
            ? 0
            : parts_.model.joints[link.hold.joint].armature[static_cast<std::size_t>(axis.axis)];
    if (armature > 0) text_ += attribute("armature", numbers({armature}));
    if (axis.is_suspension) text_ += suspension(parts_.model.joints[link.hold.joint].suspension);
    text_ += "/>";
  }

  /// MuJoCo's integrator is implicit in damping, but not in stiffness. The spring's force at the end of the
  /// step, -k (x + h v'), is that at its start with h k as damping: this gives ODE's spring, which is
  /// implicit in both.
  std::string suspension(const model::Spring& spring) const {
    return attribute("stiffness", numbers({spring.stiffness})) +
           attribute("damping", numbers({spring.damping + parts_.settings.dt_s * spring.stiffness}));
  }

  void write_inertia(const model::Body& body) {
    const model::Mat3& i = body.inertia;
    text_ += "<inertial pos='0 0 0'" + attribute("mass", numbers({body.mass_kg})) +
             attribute("fullinertia", numbers({i(0, 0), i(1, 1), i(2, 2), i(0, 1), i(0, 2), i(1, 2)})) + "/>";
  }

  void write_geom(int index) {
    const model::Geom& geom = parts_.model.geoms[index];
    const bool is_mesh = geom.shape == model::Shape::hull;
    text_ += "<geom" + attribute("name", geom_name(index)) +
             attribute("type", is_mesh ? "mesh" : std::string(model::traits_of(geom.shape).name)) +
             (is_mesh ? attribute("mesh", mesh_name(*geom.hull)) : attribute("size", size_of(geom))) +
             place(geom.local) + "/>";
  }

  /// Pairs of bodies whose geoms never touch, which the broad phase then drops; TouchRule has the last word.
  void write_excludes() {
    const model::Model& model = parts_.model;
    std::set<std::pair<int, int>> pairs;
    std::vector<std::vector<int>> of_actor(model.actors.size());
    for (int body = 0; body < model.num_bodies(); ++body) of_actor[model.bodies[body].actor].push_back(body);
    for (std::size_t actor = 0; actor < of_actor.size(); ++actor) {
      if (model.actors[actor].self_collision) continue;
      for (std::size_t i = 0; i < of_actor[actor].size(); ++i) {
        for (std::size_t j = 0; j < i; ++j) pairs.insert(std::minmax(of_actor[actor][j], of_actor[actor][i]));
      }
    }
    for (std::size_t i = 0; i < model.joints.size(); ++i) {
      const model::Joint& joint = model.joints[i];
      const bool holds = parts_.broken_in.empty() || parts_.broken_in[i] == model::unbroken;
      if (holds && joint.body_b != model::no_body) pairs.insert(std::minmax(joint.body_a, joint.body_b));
    }
    text_ += "<contact>";
    for (const auto& [a, b] : pairs)
      text_ += "<exclude" + attribute("body1", body_name(a)) + attribute("body2", body_name(b)) + "/>";
    text_ += "</contact>";
  }

  void write_constraints() {
    text_ += "<equality>";
    for (const Pin& pin : parts_.constraints.pins)
      text_ += "<joint active='false' polycoef='0 0 0 0 0'" +
               attribute("joint1", axis_name(pin.body, pin.k)) + "/>";
    for (const Closure& closure : parts_.constraints.closures) {
      text_ += (closure.welds ? std::string("<weld")
                              : "<connect" + attribute("anchor", numbers(closure.point_a))) +
               attribute("body1", body_name(closure.body_a));
      if (closure.body_b != model::no_body) text_ += attribute("body2", body_name(closure.body_b));
      if (closure.welds) text_ += attribute("relpose", weld_pose(closure.b_in_a));
      text_ += "/>";
    }
    text_ += "</equality>";
  }

  static std::string weld_pose(const model::Pose& pose) {
    const model::Quat& q = pose.orientation;
    return numbers(pose.position) + " " + numbers({q.w, q.x, q.y, q.z});
  }

  MjcfParts parts_;
  int stack_;
  std::vector<std::vector<int>> children_;            ///< [1 + bodies] children of the world and of each body
  std::vector<std::vector<int>> geoms_;               ///< [1 + bodies] geoms of the world and of each body
  std::map<const model::Hull*, std::size_t> meshes_;  ///< the number of each
  std::string text_;
};

}  // namespace

std::string body_name(int body) { return "b" + std::to_string(body); }
std::string geom_name(int geom) { return "g" + std::to_string(geom); }
std::string axis_name(int body, std::size_t k) {
  return "j" + std::to_string(body) + "." + std::to_string(k);
}

std::string mjcf_text(const MjcfParts& parts, int stack) { return Writer(parts, stack).write(); }

}  // namespace pbmpi::mujoco
