#include "scenes/mjcf/mjcf.h"

#include <algorithm>
#include <array>

#include "core/error.h"
#include "core/text.h"
#include "scenes/mjcf/body_reader.h"

namespace pbmpi::scenes::mjcf {
namespace {

using xml::Attributes;

/// Sections whose elements are seen, measured, or looked up by name, and do not affect motion.
constexpr std::array<std::string_view, 7> sections_that_move_nothing = {
    "asset", "visual", "statistic", "size", "sensor", "custom", "keyframe"};

class Reader {
 public:
  Reader(const xml::Element& root, const std::set<std::string>& leave_out, xml::Notes& notes)
      : root_(root), notes_(notes) {
    context_.leave_out = leave_out;
  }

  links::ModelFile read() {
    Attributes mujoco(root_);
    file_.mechanism.name = mujoco.text("model", "");
    mujoco.finish();
    for_each("compiler", [&](const xml::Element& one) { read_compiler(one, context_.compiler); });
    for_each("option", [&](const xml::Element& one) { read_option(one, context_.option, notes_); });
    for_each("default", [&](const xml::Element& one) { context_.defaults.read(one); });
    read_world();
    for_each("contact", [&](const xml::Element& one) { read_contact(one); });
    for_each("actuator", [&](const xml::Element& one) {
      if (context_.option.has_actuators)
        read_actuators(one, context_.defaults, context_.compiler, joints_, context_.leave_out,
                       file_.mechanism, notes_);
    });
    for (const xml::Element& one : root_.children) require_known(one);
    scale_mass();
    file_.gravity = context_.option.gravity;
    file_.dt_s = context_.option.timestep_s;
    return std::move(file_);
  }

 private:
  template <class Visit>
  void for_each(std::string_view name, Visit visit) const {
    for (const xml::Element& one : root_.children) {
      if (one.name == name) visit(one);
    }
  }

  void read_world() {
    int count = 0;
    for_each("worldbody", [&](const xml::Element& one) {
      core::require_input(++count == 1, one.where + ": a second <worldbody>; put its bodies into the first");
      joints_ = read_bodies(one, context_, file_.mechanism, notes_);
    });
    core::require_input(count == 1, root_.where + ": there is no <worldbody>; give one with bodies");
  }

  int named_link(Attributes& exclude, const char* key) const {
    const std::string name = exclude.text(key);
    std::vector<std::string> names;
    for (std::size_t i = 0; i < file_.mechanism.links.size(); ++i) {
      names.push_back(file_.mechanism.links[i].name);
      if (names.back() == name) return static_cast<int>(i);
    }
    exclude.fail(key, "unknown body " + core::in_quotes(name) + core::suggestion(name, names));
  }

  void read_contact(const xml::Element& contact) {
    for (const xml::Element& one : contact.children) {
      if (one.name != "exclude") {
        leave_out_or_fail(one, "only <exclude> of <contact> can be read");
        continue;
      }
      Attributes exclude(one);
      const int first = named_link(exclude, "body1");
      file_.mechanism.apart.emplace_back(first, named_link(exclude, "body2"));
      exclude.allow({"name", "class"});
      exclude.finish();
    }
  }

  /// Refuses elements that affect motion and that pbmpi does not read.
  void require_known(const xml::Element& one) {
    constexpr std::array<std::string_view, 6> read = {"compiler",  "option",  "default",
                                                      "worldbody", "contact", "actuator"};
    if (std::ranges::find(read, one.name) != read.end()) return;
    if (std::ranges::find(sections_that_move_nothing, one.name) != sections_that_move_nothing.end()) return;
    constexpr std::array<std::string_view, 5> known = {"equality", "tendon", "include", "deformable",
                                                       "extension"};
    if (std::ranges::find(known, one.name) == known.end()) {
      std::vector<std::string> names;
      names.insert(names.end(), read.begin(), read.end());
      names.insert(names.end(), sections_that_move_nothing.begin(), sections_that_move_nothing.end());
      names.insert(names.end(), known.begin(), known.end());
      Attributes(one).fail("unknown element" + core::suggestion(one.name, names));
    }
    if (one.name == "include")
      Attributes(one).fail("a scene is one file, so that it says all; write out what it includes");
    for (const xml::Element& child : one.children) {
      const xml::Attribute* active = child.find("active");
      const bool is_off = one.name == "equality" && active != nullptr && active->value == "false";
      const bool is_idle = one.name == "tendon" && is_idle_tendon(child);
      if (is_off || is_idle || context_.leave_out.contains(one.name)) {
        if (!is_off && !is_idle) notes_.add(child.where, core::in_quotes(one.name) + " is left out");
      } else {
        leave_out_or_fail(child, core::in_quotes(one.name) + " has no equal");
      }
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
    if (!context_.leave_out.contains(one.name))
      Attributes(one).fail(problem + "; take it out, or leave it out ('leave_out' of a TOML scene)");
    notes_.add(one.where, core::in_quotes(one.name) + " is left out");
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
  xml::Notes& notes_;
  Context context_;
  links::ModelFile file_;
  std::vector<JointPlace> joints_;
};

}  // namespace

links::ModelFile read(const xml::Element& root, const std::set<std::string>& leave_out, xml::Notes& notes) {
  return Reader(root, leave_out, notes).read();
}

}  // namespace pbmpi::scenes::mjcf
