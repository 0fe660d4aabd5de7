#include "scenes/mjcf/mjcf.h"

#include <algorithm>
#include <array>

#include "core/error.h"
#include "core/text.h"
#include "scenes/mjcf/body_reader.h"
#include "scenes/mjcf/keyframe.h"
#include "scenes/parts/name_index.h"

namespace pbmpi::scenes::mjcf {
namespace {

using xml::Attributes;

/// Sections whose elements are seen, measured, or looked up by name, and do not affect motion.
constexpr std::array<std::string_view, 6> sections_that_move_nothing = {"asset", "visual", "statistic",
                                                                        "size",  "sensor", "custom"};

class Reader {
 public:
  Reader(const xml::Element& root, const std::string& keyframe, const xml::LeaveOut& leave_out)
      : root_(root),
        keyframe_name_(keyframe),
        leave_out_(leave_out),
        context_{Compiler(), Option(), Defaults(), leave_out} {}

  links::ModelFile read() {
    Attributes mujoco(root_, leave_out_);
    file_.mechanism.name = mujoco.text("model", "");
    mujoco.finish();
    for (const xml::Element* one : all("compiler")) read_compiler(*one, leave_out_, context_.compiler);
    for (const xml::Element* one : all("option")) read_option(*one, leave_out_, context_.option);
    for (const xml::Element* one : all("default")) context_.defaults.read(*one);
    keyframe_ = read_keyframe(all("keyframe"), keyframe_name_, leave_out_);
    read_world();
    for (const xml::Element* one : all("contact")) read_contact(*one);
    if (context_.option.has_actuators) read_actuators();
    for (const xml::Element& one : root_.children) require_known(one);
    scale_mass();
    file_.gravity = context_.option.gravity;
    file_.dt_s = context_.option.timestep_s;
    return std::move(file_);
  }

 private:
  std::vector<const xml::Element*> all(std::string_view name) const {
    std::vector<const xml::Element*> found;
    for (const xml::Element& one : root_.children) {
      if (one.name == name) found.push_back(&one);
    }
    return found;
  }

  void read_world() {
    const std::vector<const xml::Element*> worlds = all("worldbody");
    core::require_input(!worlds.empty(), root_.where + ": there is no <worldbody>; give one with bodies");
    joints_ = read_bodies(worlds, context_, file_.mechanism);
    keyframe_.move(joints_, file_.mechanism);
  }

  void read_actuators() {
    std::vector<const xml::Element*> all_actuators;
    for (const xml::Element* section : all("actuator")) {
      for (const xml::Element& one : section->children) all_actuators.push_back(&one);
    }
    const std::vector<double> controls = keyframe_.controls(all_actuators.size());
    ActuatorReader reader(context_, joints_, file_.mechanism);
    for (std::size_t i = 0; i < all_actuators.size(); ++i) reader.read(*all_actuators[i], controls[i]);
  }

  int named_link(Attributes& exclude, const char* key) {
    const std::string name = exclude.text(key);
    if (const auto found = link_names_.find(file_.mechanism.links, name)) return *found;
    const std::vector<std::string> names = names_of(file_.mechanism.links);
    exclude.fail(key, "unknown body " + core::in_quotes(name) + core::suggestion(name, names));
  }

  void read_contact(const xml::Element& contact) {
    for (const xml::Element& one : contact.children) {
      if (one.name != "exclude") {
        leave_out_or_fail(one, "only <exclude> of <contact> can be read");
        continue;
      }
      Attributes exclude(one, leave_out_);
      const int first = named_link(exclude, "body1");
      file_.mechanism.apart.emplace_back(first, named_link(exclude, "body2"));
      exclude.allow({"name", "class"});
      exclude.finish();
    }
  }

  /// Refuses elements that affect motion and that pbmpi does not read.
  void require_known(const xml::Element& one) {
    constexpr std::array<std::string_view, 7> read = {"compiler", "option",   "default", "worldbody",
                                                      "contact",  "actuator", "keyframe"};
    if (std::ranges::find(read, one.name) != read.end()) return;
    if (std::ranges::find(sections_that_move_nothing, one.name) != sections_that_move_nothing.end()) return;
    constexpr std::array<std::string_view, 4> known = {"equality", "tendon", "deformable", "extension"};
    if (std::ranges::find(known, one.name) == known.end()) {
      if (leave_out_.drops(one.name, one.where)) return;
      std::vector<std::string> names;
      names.insert(names.end(), read.begin(), read.end());
      names.insert(names.end(), sections_that_move_nothing.begin(), sections_that_move_nothing.end());
      names.insert(names.end(), known.begin(), known.end());
      names.emplace_back("include");
      Attributes(one).fail("unknown element; take it out, or " + xml::LeaveOut::advice(one.name) +
                           core::suggestion(one.name, names));
    }
    for (const xml::Element& child : one.children) {
      const xml::Attribute* active = child.find("active");
      const bool is_off = one.name == "equality" && active != nullptr && active->value == "false";
      const bool is_idle = one.name == "tendon" && is_idle_tendon(child);
      if (is_off || is_idle || leave_out_.drops(one.name, child.where)) continue;
      leave_out_or_fail(child, core::in_quotes(one.name) + " has no equal");
    }
  }

  /// Does the tendon have no spring, damper, limit or friction?
  bool is_idle_tendon(const xml::Element& tendon) const {
    Attributes attributes(tendon, context_.defaults.of(tendon, ""));
    constexpr std::array<std::string_view, 6> laws = {"limited", "range",        "stiffness",
                                                      "damping", "frictionloss", "armature"};
    return std::ranges::none_of(laws, [&](std::string_view law) { return attributes.has(law); });
  }

  void leave_out_or_fail(const xml::Element& one, const std::string& problem) {
    if (!leave_out_.drops(one.name, one.where)) xml::refuse_element(one, problem + "; take it out");
  }

  void scale_mass() {
    if (!context_.compiler.total_mass) return;
    double sum = 0;
    for (const links::Link& link : file_.mechanism.links) sum += link.mass ? link.mass->mass_kg : 0;
    if (!(sum > 0)) return;
    const double factor = *context_.compiler.total_mass / sum;
    for (links::Link& link : file_.mechanism.links) {
      if (!link.mass) continue;
      link.mass->mass_kg *= factor;
      link.mass->inertia *= factor;
    }
  }

  const xml::Element& root_;
  const std::string& keyframe_name_;
  const xml::LeaveOut& leave_out_;
  Context context_;
  Keyframe keyframe_;
  links::ModelFile file_;
  std::vector<JointPlace> joints_;
  NameIndex link_names_;
};

}  // namespace

links::ModelFile read(const xml::Element& root, const std::string& keyframe, const xml::LeaveOut& leave_out) {
  return Reader(root, keyframe, leave_out).read();
}

}  // namespace pbmpi::scenes::mjcf
