#include "scenes/mjcf/body_reader.h"

#include <algorithm>
#include <array>
#include <set>

#include "core/error.h"
#include "core/text.h"
#include "scenes/links/rigid.h"
#include "scenes/mjcf/body_joint_reader.h"
#include "scenes/mjcf/geom_reader.h"

namespace pbmpi::scenes::mjcf {
namespace {

using xml::Attributes;

/// Elements that are seen or measured, and do not affect motion.
constexpr std::array<std::string_view, 3> onlookers_of_bodies = {"site", "camera", "light"};

void collect_names(const xml::Element& element, std::set<std::string>& names) {
  for (const xml::Element& child : element.children) {
    if (child.name != "body") continue;
    names.insert(Attributes(child).text("name", ""));
    collect_names(child, names);
  }
}

class BodyReader {
 public:
  BodyReader(const Context& context, links::Mechanism& mechanism)
      : context_(context), mechanism_(mechanism), notes_(context.leave_out.notes()) {}

  void read_worlds(const std::vector<const xml::Element*>& worlds) {
    links::Link link;
    link.name = "world";
    link.where = worlds.front()->where;
    mechanism_.links.push_back(std::move(link));
    for (const xml::Element* world : worlds) collect_names(*world, given_names_);
    for (const xml::Element* world : worlds) {
      Attributes(*world, context_.leave_out).finish();
      read_children(*world, 0, "");
    }
  }

  std::vector<JointPlace> take_joints() { return std::move(joints_); }

 private:
  void read_body(const xml::Element& element, int parent, std::string childclass) {
    Attributes body(element, context_.leave_out);
    const auto index = static_cast<int>(mechanism_.links.size());
    links::Link link;
    link.name = body.text("name", unused_name(index));
    link.where = element.where;
    link.parent = parent;
    link.pose = read_pose(body, context_.compiler);
    childclass = body.text("childclass", childclass);
    if (body.flag("mocap", false))
      body.fail_unless_left_out("mocap",
                                "'mocap' bodies, which are moved from outside, have no equal; take it out");
    if (body.number("gravcomp", xml::Range::any, 0.0) != 0)
      body.fail_unless_left_out("gravcomp", "gravity acts on all bodies alike; take 'gravcomp' out");
    body.allow({"user", "sleep"});
    body.finish();
    mechanism_.links.push_back(std::move(link));
    read_children(element, index, childclass);
  }

  /// A name for a body that has none.
  std::string unused_name(int index) const {
    std::string name = "body" + std::to_string(index);
    while (given_names_.contains(name)) name += '_';
    return name;
  }

  /// Child bodies come last, since their links come after this one's.
  void read_children(const xml::Element& element, int index, const std::string& childclass) {
    std::optional<MassProperties> inertial, of_geoms;
    for (const xml::Element& child : element.children) {
      if (child.name == "inertial") {
        core::require_input(!inertial, child.where + ": a second <inertial> of one body; leave one");
        inertial = read_inertial(child, context_.compiler, context_.leave_out);
      } else if (child.name == "geom") {
        add_geom(child, index, childclass, of_geoms);
      } else if (child.name == "joint" || child.name == "freejoint") {
        add_joint(child, index, childclass);
      } else if (child.name != "body") {
        skip(child);
      }
    }
    set_mass(inertial, of_geoms, index);
    check_joints(index);
    for (const xml::Element& child : element.children) {
      if (child.name == "body") read_body(child, index, childclass);
    }
  }

  void skip(const xml::Element& child) {
    if (std::ranges::find(onlookers_of_bodies, child.name) != onlookers_of_bodies.end()) return;
    if (!context_.leave_out.drops(child.name, child.where))
      xml::refuse_element(child, "this element cannot be read here; write out its bodies");
  }

  links::Link& link(int index) { return mechanism_.links[static_cast<std::size_t>(index)]; }

  void add_geom(const xml::Element& element, int index, const std::string& childclass,
                std::optional<MassProperties>& sum) {
    ReadGeom read = read_geom(Attributes(element, context_.defaults.of(element, childclass)),
                              context_.compiler, context_.leave_out);
    if (read.mass) sum = sum ? links::together(*sum, *read.mass) : *read.mass;
    if (!read.geom) return;
    if (!context_.option.collides) read.geom->contype = read.geom->conaffinity = 0;
    link(index).geoms.push_back(*read.geom);
  }

  void add_joint(const xml::Element& element, int index, const std::string& childclass) {
    links::Link& own = link(index);
    const std::string name =
        own.name + ".joint" + (own.joints.empty() ? "" : std::to_string(own.joints.size() + 1));
    ReadJoint read;
    if (element.name == "freejoint") {
      read.joint = read_free_joint(element, name, context_.leave_out);
    } else {
      read = read_joint(Attributes(element, context_.leave_out, context_.defaults.of(element, childclass)),
                        name, context_.compiler, context_.option, notes_);
    }
    joints_.push_back({read.joint.name, index, static_cast<int>(own.joints.size()), read.most_servo_force});
    own.joints.push_back(std::move(read.joint));
  }

  void check_joints(int index) {
    const links::Link& own = link(index);
    for (const links::LinkJoint& joint : own.joints) {
      core::require_input(own.parent != links::no_link,
                          joint.where + ": the world itself has no joint; put it into a <body>");
      if (joint.motion != links::Motion::free) continue;
      core::require_input(own.joints.size() == 1,
                          joint.where + ": a free body has no other joint; leave the others out");
      core::require_input(own.parent == 0, joint.where + ": only a body of <worldbody> itself can be free");
    }
  }

  /// The world has no mass, whatever stands in it; every other body has at least the mass that <compiler>
  /// asks for.
  void set_mass(const std::optional<MassProperties>& inertial, const std::optional<MassProperties>& of_geoms,
                int index) {
    if (index == 0) return;
    const InertiaFrom from = context_.compiler.inertia_from;
    std::optional<MassProperties> mass = from == InertiaFrom::geoms && of_geoms ? of_geoms : inertial;
    if (from == InertiaFrom::geoms_if_none && !mass) mass = of_geoms;
    if (!mass && context_.compiler.least_mass > 0)
      mass = MassProperties{0, Vec3::Zero(), model::Mat3::Zero()};
    if (mass) link(index).mass = adjusted(*mass, context_.compiler);
  }

  const Context& context_;
  links::Mechanism& mechanism_;
  xml::Notes& notes_;
  std::set<std::string> given_names_;  ///< of bodies
  std::vector<JointPlace> joints_;
};

}  // namespace

std::vector<JointPlace> read_bodies(const std::vector<const xml::Element*>& worlds, const Context& context,
                                    links::Mechanism& mechanism) {
  BodyReader reader(context, mechanism);
  reader.read_worlds(worlds);
  return reader.take_joints();
}

}  // namespace pbmpi::scenes::mjcf
