#include "scenes/mjcf/mjcf.h"

#include <algorithm>
#include <array>

#include "core/error.h"
#include "core/text.h"
#include "scenes/mjcf/body_reader.h"
#include "scenes/mjcf/contact_reader.h"
#include "scenes/mjcf/equality_reader.h"
#include "scenes/mjcf/keyframe.h"
#include "scenes/mjcf/servo_reader.h"

namespace pbmpi::scenes::mjcf {
namespace {

using xml::Attributes;

/// Sections whose elements are seen, measured, or looked up by name, and do not affect motion.
constexpr std::array<std::string_view, 6> sections_that_move_nothing = {"asset", "visual", "statistic",
                                                                        "size",  "sensor", "custom"};

class Reader {
 public:
  Reader(const std::string& file, const xml::Texts& texts, const std::string& keyframe,
         const xml::LeaveOut& leave_out)
      : keyframe_name_(keyframe), leave_out_(leave_out), attachments_(file, texts, leave_out) {}

  links::ModelFile read() {
    const Part& main = attachments_.main();
    Attributes mujoco(*main.root, leave_out_);
    file_.mechanism.name = mujoco.text("model", "");
    mujoco.finish();
    const Keyframe keyframe = read_keyframe(main.sections("keyframe"), keyframe_name_, leave_out_);
    core::require_input(!main.sections("worldbody").empty(),
                        main.root->where + ": there is no <worldbody>; give one with bodies");
    places_ = read_bodies(attachments_, file_.mechanism);
    if (main.context->option.has_equality) read_equalities();
    keyframe.move(places_, file_.mechanism);
    read_contacts();
    if (main.context->option.has_actuators) read_actuators(keyframe);
    for (const Part& part : attachments_.parts()) require_known(part);
    if (main.context->compiler.total_mass) scale_mass(*main.context->compiler.total_mass);
    file_.gravity = main.context->option.gravity;
    file_.dt_s = main.context->option.timestep_s;
    return std::move(file_);
  }

 private:
  /// Calls read(element, part) for the elements in the sections of that name.
  void for_each_in(std::string_view section, const auto& read) const {
    for (const Part& part : attachments_.parts()) {
      for (const xml::Element* one : part.sections(section)) {
        for (const xml::Element& child : one->children) read(child, part);
      }
    }
  }

  void read_equalities() {
    EqualityReader reader(places_, file_.mechanism);
    for_each_in("equality", [&](const xml::Element& one, const Part& part) {
      if (!leave_out_.drops("equality", one.where) && !leave_out_.drops(one.name, one.where))
        reader.read(one, part);
    });
  }

  void read_actuators(const Keyframe& keyframe) {
    std::vector<std::pair<const xml::Element*, const Part*>> elements;
    for_each_in("actuator",
                [&](const xml::Element& one, const Part& part) { elements.emplace_back(&one, &part); });
    const bool are_copied =
        attachments_.parts().size() > 1 ||
        std::ranges::any_of(places_.joints, [](const JointPlace& joint) { return !joint.copies.empty(); });
    const std::vector<double> controls = keyframe.controls(elements.size(), are_copied);
    ActuatorReader reader(places_, file_.mechanism);
    for (std::size_t i = 0; i < elements.size(); ++i)
      reader.read(*elements[i].first, controls[i], *elements[i].second);
  }

  void read_contacts() {
    ContactReader reader(places_, file_.mechanism);
    for_each_in("contact", [&](const xml::Element& one, const Part& part) { reader.read(one, part); });
  }

  /// Refuses elements that affect motion and that pbmpi does not read.
  void require_known(const Part& part) const {
    for (const xml::Element& one : part.root->children) require_known(one, part);
  }

  void require_known(const xml::Element& one, const Part& part) const {
    constexpr std::array<std::string_view, 8> read = {"compiler", "option",   "default",  "worldbody",
                                                      "contact",  "actuator", "keyframe", "equality"};
    if (std::ranges::find(read, one.name) != read.end()) return;
    if (std::ranges::find(sections_that_move_nothing, one.name) != sections_that_move_nothing.end()) return;
    constexpr std::array<std::string_view, 3> known = {"tendon", "deformable", "extension"};
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
      const bool is_idle = one.name == "tendon" && is_idle_tendon(child, *part.context);
      if (is_idle || leave_out_.drops(one.name, child.where)) continue;
      leave_out_or_fail(child, core::in_quotes(one.name) + " has no equal");
    }
  }

  /// Does the tendon have no spring, damper, limit or friction?
  static bool is_idle_tendon(const xml::Element& tendon, const Context& context) {
    Attributes attributes(tendon, context.defaults.of(tendon, ""));
    constexpr std::array<std::string_view, 6> laws = {"limited", "range",        "stiffness",
                                                      "damping", "frictionloss", "armature"};
    return std::ranges::none_of(laws, [&](std::string_view law) { return attributes.has(law); });
  }

  void leave_out_or_fail(const xml::Element& one, const std::string& problem) const {
    if (!leave_out_.drops(one.name, one.where)) xml::refuse_element(one, problem + "; take it out");
  }

  void scale_mass(double total_mass) {
    double sum = 0;
    for (const links::Link& link : file_.mechanism.links) sum += link.mass ? link.mass->mass_kg : 0;
    if (!(sum > 0)) return;
    const double factor = total_mass / sum;
    for (links::Link& link : file_.mechanism.links) {
      if (!link.mass) continue;
      link.mass->mass_kg *= factor;
      link.mass->inertia *= factor;
    }
  }

  const std::string& keyframe_name_;
  const xml::LeaveOut& leave_out_;
  Attachments attachments_;
  Places places_;
  links::ModelFile file_;
};

}  // namespace

links::ModelFile read(const std::string& file, const xml::Texts& texts, const std::string& keyframe,
                      const xml::LeaveOut& leave_out) {
  return Reader(file, texts, keyframe, leave_out).read();
}

}  // namespace pbmpi::scenes::mjcf
