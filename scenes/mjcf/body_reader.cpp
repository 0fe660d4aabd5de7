#include "scenes/mjcf/body_reader.h"

#include <algorithm>
#include <array>
#include <functional>
#include <optional>
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
constexpr std::array<std::string_view, 2> onlookers_of_bodies = {"camera", "light"};

/// What elements take from those around them.
struct Scope {
  const Part* part = nullptr;
  std::string childclass;
  Pose frame;          ///< of <frame>s, in the frame of the body around them
  std::string suffix;  ///< of names
  std::vector<Copy> copies;
  std::vector<const xml::Element*> attaching;  ///< the <attach> elements around, outermost first

  const Context& context() const { return *part->context; }
  /// A name of the file as the mechanism has it.
  std::string named(const std::string& name) const {
    return name.empty() ? name : part->prefix + name + suffix;
  }
  Named place_of(const std::string& name) const { return {part->prefix + name, suffix, part, copies}; }
};

constexpr std::size_t most_attached = 50;  // one within another: more would overflow the stack

struct MassOfGeoms {
  std::optional<MassProperties> known;
  std::string unknown;  ///< why the mass of a geom is not known; empty: all are
};

/// The number of a copy, with as many digits as the last one has.
std::string number_of(int copy, int count) {
  const std::string number = std::to_string(copy);
  return std::string(std::to_string(count - 1).size() - number.size(), '0') + number;
}

class BodyReader {
 public:
  BodyReader(Attachments& attachments, links::Mechanism& mechanism)
      : attachments_(attachments),
        mechanism_(mechanism),
        leave_out_(attachments.main().context->leave_out),
        notes_(leave_out_.notes()) {}

  Places read() {
    const std::vector<const xml::Element*> worlds = attachments_.main().sections("worldbody");
    Scope scope;
    scope.part = &attachments_.main();
    links::Link link;
    link.name = "world";
    link.where = worlds.front()->where;
    mechanism_.links.push_back(std::move(link));
    places_.bodies.push_back({{"world", "", &attachments_.main(), {}}, 0});
    for (const xml::Element* world : worlds) {
      Attributes(*world, leave_out_).finish();
      read_children(*world, 0, scope);
    }
    name_the_nameless();
    return std::move(places_);
  }

 private:
  using Visit = std::function<void(const xml::Element&, const Scope&)>;

  void read_body(const xml::Element& element, int parent, const Scope& around) {
    const Context& context = around.context();
    Attributes body(element, leave_out_);
    const auto index = static_cast<int>(mechanism_.links.size());
    const std::string name = body.text("name", "");
    links::Link link;
    link.name = around.named(name);
    link.where = element.where;
    link.parent = parent;
    link.pose = compose(around.frame, read_pose(body, context.compiler));
    Scope scope = around;
    scope.frame = {};
    scope.childclass = body.text("childclass", around.childclass);
    if (body.flag("mocap", false)) {
      notes_.add(element.where, "'mocap' bodies stand where they are: nothing moves them");
      places_.mocap_links.push_back(index);
    }
    if (body.number("gravcomp", xml::Range::any, 0.0) != 0)
      body.fail_unless_left_out("gravcomp", "gravity acts on all bodies alike; take 'gravcomp' out");
    body.allow({"user", "sleep"});
    body.finish();
    mechanism_.links.push_back(std::move(link));
    places_.bodies.push_back({scope.place_of(name), index});
    read_children(element, index, scope);
  }

  /// Visits the elements below one, with all copies, those of frames and of what is attached included.
  void for_each(const xml::Element& element, const Scope& scope, const Visit& visit) {
    for (const xml::Element& child : element.children) {
      count(child, 1);
      if (child.name == "frame")
        for_each(child, in_frame(child, scope), visit);
      else if (child.name == "replicate")
        replicate(child, scope, visit);
      else if (child.name == "attach" && !leave_out_.drops(child.name, child.where))
        attach(child, scope, visit);
      else if (child.name != "attach")
        visit(child, scope);
    }
  }

  void count(const xml::Element& element, int more) {
    if (more > most_elements - num_elements_)
      throw core::InputError(element.where + ": " + element.name +
                             ": with all copies the model has more than " + std::to_string(most_elements) +
                             " elements; make fewer");
    num_elements_ += more;
  }

  Scope in_frame(const xml::Element& element, const Scope& around) {
    Attributes frame(element, leave_out_);
    Scope scope = around;
    scope.frame = compose(around.frame, read_pose(frame, around.context().compiler));
    scope.childclass = frame.text("childclass", around.childclass);
    frame.allow({"name"});
    frame.finish();
    return scope;
  }

  /// Each copy stands at the `offset` from the one before, in its frame, and is turned by its number times
  /// the angles.
  void replicate(const xml::Element& element, const Scope& around, const Visit& visit) {
    Attributes attributes(element, leave_out_);
    if (!attributes.has("count")) attributes.fail("it has no 'count'; give the number of copies");
    const int num_copies = attributes.integer("count", 1, 1);
    count(element, num_copies);
    const Vec3 offset = attributes.vector("offset", Vec3(Vec3::Zero()));
    const Vec3 angles = attributes.vector("euler", Vec3(Vec3::Zero()));
    const std::string separator = attributes.text("sep", "");
    Scope scope = around;
    scope.childclass = attributes.text("childclass", around.childclass);
    attributes.allow({"prefix"});
    attributes.finish();
    scope.copies.emplace_back(&element, 0);
    Pose pose;
    for (int copy = 0; copy < num_copies; ++copy) {
      pose.orientation = turn_by_euler(copy * angles, around.context().compiler);
      scope.frame = compose(around.frame, pose);
      scope.suffix = separator + number_of(copy, num_copies) + around.suffix;
      scope.copies.back().second = copy;
      for_each(element, scope, visit);
      pose.position = pose.point_to_outer(offset);
    }
  }

  void attach(const xml::Element& element, const Scope& around, const Visit& visit) {
    if (std::ranges::find(around.attaching, &element) != around.attaching.end())
      throw core::InputError(element.where + ": what is attached attaches itself; attach another part");
    core::require_input(around.attaching.size() < most_attached,
                        element.where + ": more than 50 <attach> within another; attach fewer");
    const Attached attached = attachments_.attach(element, *around.part);
    Scope scope = around;
    scope.part = attached.part;
    scope.childclass = attached.childclass;
    scope.attaching.push_back(&element);
    if (attached.element->name == "body")
      visit(*attached.element, scope);
    else if (attached.element->name == "frame")
      for_each(*attached.element, in_frame(*attached.element, scope), visit);
    else
      for_each(*attached.element, scope, visit);
  }

  /// Child bodies come last, since their links come after this one's.
  void read_children(const xml::Element& element, int index, const Scope& scope) {
    std::optional<MassProperties> inertial;
    MassOfGeoms of_geoms;
    std::vector<std::pair<const xml::Element*, Scope>> bodies;
    for_each(element, scope, [&](const xml::Element& child, const Scope& inner) {
      if (child.name == "inertial") {
        core::require_input(!inertial, child.where + ": a second <inertial> of one body; leave one");
        inertial = links::moved(read_inertial(child, inner.context().compiler, leave_out_), inner.frame);
      } else if (child.name == "geom") {
        add_geom(child, index, inner, of_geoms);
      } else if (child.name == "joint" || child.name == "freejoint") {
        add_joint(child, index, inner);
      } else if (child.name == "site") {
        const xml::Attribute* name = child.find("name");
        if (name != nullptr)
          places_.sites.push_back(
              {inner.place_of(name->value), index, inner.frame, &child, inner.childclass});
      } else if (child.name == "body") {
        bodies.emplace_back(&child, inner);
      } else {
        skip(child);
      }
    });
    set_mass(inertial, of_geoms, index, scope.context().compiler);
    check_joints(index);
    for (const auto& [body, inner] : bodies) read_body(*body, index, inner);
  }

  void skip(const xml::Element& child) const {
    if (std::ranges::find(onlookers_of_bodies, child.name) != onlookers_of_bodies.end()) return;
    if (!leave_out_.drops(child.name, child.where))
      xml::refuse_element(child, "this element cannot be read here; write out its bodies");
  }

  links::Link& link(int index) { return mechanism_.links[static_cast<std::size_t>(index)]; }

  void add_geom(const xml::Element& element, int index, const Scope& scope, MassOfGeoms& sum) {
    const Context& context = scope.context();
    ReadGeom read = read_geom(Attributes(element, context.defaults.of(element, scope.childclass)), context);
    if (read.mass) {
      const MassProperties mass = links::moved(*read.mass, scope.frame);
      sum.known = sum.known ? links::together(*sum.known, mass) : mass;
    }
    if (sum.unknown.empty()) sum.unknown = read.unknown_mass;
    if (!read.geom) return;
    read.geom->pose = compose(scope.frame, read.geom->pose);
    if (const xml::Attribute* name = element.find("name"))
      places_.geoms.push_back(
          {scope.place_of(name->value), index, static_cast<int>(link(index).geoms.size())});
    link(index).geoms.push_back(*read.geom);
  }

  void add_joint(const xml::Element& element, int index, const Scope& scope) {
    const Context& context = scope.context();
    links::Link& own = link(index);
    const xml::Attribute* name = element.find("name");
    ReadJoint read;
    if (element.name == "freejoint") {
      read.joint = read_free_joint(element, "", leave_out_);
    } else {
      read = read_joint(Attributes(element, leave_out_, context.defaults.of(element, scope.childclass)), "",
                        context.compiler, context.option, leave_out_);
    }
    read.joint.name = scope.named(read.joint.name);
    read.joint.anchor = scope.frame.point_to_outer(read.joint.anchor);
    read.joint.axis = scope.frame.direction_to_outer(read.joint.axis);
    places_.joints.push_back({scope.place_of(name == nullptr ? "" : name->value), index,
                              static_cast<int>(own.joints.size()), read.most_servo_force});
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
  void set_mass(const std::optional<MassProperties>& inertial, const MassOfGeoms& of_geoms, int index,
                const Compiler& compiler) {
    if (index == 0) return;
    const InertiaFrom from = compiler.inertia_from;
    const bool takes_geoms = from == InertiaFrom::geoms || (from == InertiaFrom::geoms_if_none && !inertial);
    if (takes_geoms && !of_geoms.unknown.empty() && !is_static(index))
      throw core::InputError(of_geoms.unknown);
    std::optional<MassProperties> mass = takes_geoms && of_geoms.known ? of_geoms.known : inertial;
    if (!mass && compiler.least_mass > 0) mass = MassProperties{0, Vec3::Zero(), model::Mat3::Zero()};
    if (mass) link(index).mass = adjusted(*mass, compiler);
  }

  /// Does neither the link nor one above it have a joint?
  bool is_static(int index) const {
    for (int at = index; at != links::no_link; at = mechanism_.links[static_cast<std::size_t>(at)].parent) {
      if (!mechanism_.links[static_cast<std::size_t>(at)].joints.empty()) return false;
    }
    return true;
  }

  void name_the_nameless() {
    std::set<std::string> taken;
    for (const links::Link& one : mechanism_.links) taken.insert(one.name);
    for (std::size_t i = 0; i < mechanism_.links.size(); ++i) {
      links::Link& one = mechanism_.links[i];
      if (one.name.empty()) {
        one.name = "body" + std::to_string(i);
        while (taken.contains(one.name)) one.name += '_';
      }
      for (std::size_t joint = 0; joint < one.joints.size(); ++joint) {
        if (one.joints[joint].name.empty())
          one.joints[joint].name = one.name + ".joint" + (joint == 0 ? "" : std::to_string(joint + 1));
      }
    }
  }

  Attachments& attachments_;
  links::Mechanism& mechanism_;
  const xml::LeaveOut& leave_out_;
  xml::Notes& notes_;
  Places places_;
  int num_elements_ = 0;
};

}  // namespace

Places read_bodies(Attachments& attachments, links::Mechanism& mechanism) {
  return BodyReader(attachments, mechanism).read();
}

}  // namespace pbmpi::scenes::mjcf
