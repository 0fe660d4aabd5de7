#include "scenes/mjcf/settings/defaults.h"

#include <algorithm>
#include <array>
#include <iterator>

#include "core/error.h"
#include "core/text.h"
#include "scenes/xml/attributes.h"

namespace pbmpi::scenes::mjcf {
namespace {

constexpr std::string_view topmost = "main";

constexpr std::array<std::string_view, 11> actuators = {"general",     "motor",  "position", "velocity",
                                                        "intvelocity", "damper", "cylinder", "muscle",
                                                        "adhesion",    "plugin", "dcmotor"};
/// Elements that take the defaults of <tendon>.
constexpr std::array<std::string_view, 2> tendons = {"spatial", "fixed"};
constexpr std::array<std::string_view, 10> others = {"mesh",   "material", "joint", "geom",     "site",
                                                     "camera", "light",    "pair",  "equality", "tendon"};

/// The name under which all kinds of actuators share their defaults: a default of one is a default of all.
constexpr const char* any_actuator = "actuator";
constexpr std::array<std::string_view, 5> common = {"ctrllimited", "ctrlrange", "forcelimited", "forcerange",
                                                    "gear"};

bool is_in(std::string_view word, auto& words) { return std::ranges::find(words, word) != std::end(words); }

}  // namespace

bool is_actuator(std::string_view element) { return is_in(element, actuators); }

void Defaults::read(const xml::Element& element) {
  const xml::Attribute* name = element.find("class");
  core::require_input(name == nullptr || name->value == topmost,
                      element.where + ": the topmost class is called 'main'; nest <default class=...> in it");
  read_class(element, std::string(topmost));
}

/// Reads a class. The classes inside it inherit what it has, after their own attributes.
void Defaults::read_class(const xml::Element& element, const std::string& name) {
  ByElement& own = classes_[name];
  for (const xml::Element& child : element.children) {
    if (child.name == "default") continue;
    if (!is_in(child.name, others) && !is_actuator(child.name))
      xml::Attributes(child).fail(
          "unknown element in <default>; it has defaults of joints, geoms, actuators and so on");
    for (const xml::Attribute& attribute : child.attributes) {
      const bool is_common = is_actuator(child.name) && is_in(attribute.name, common);
      auto& list = own[is_common ? any_actuator : child.name];
      list.insert(list.begin(), attribute);
    }
  }
  for (const xml::Element& child : element.children) {
    if (child.name != "default") continue;
    const xml::Attribute* below = child.find("class");
    core::require_input(below != nullptr, child.where + ": a <default> in another needs a 'class'; name it");
    core::require_input(classes_.emplace(below->value, own).second,
                        below->where + ": a second class " + core::in_quotes(below->value) + "; rename one");
    read_class(child, below->value);
  }
}

std::vector<xml::Attribute> Defaults::of(const xml::Element& element, const std::string& childclass,
                                         std::string_view kind) const {
  const xml::Attribute* named = element.find("class");
  const std::string name = named != nullptr     ? named->value
                           : childclass.empty() ? std::string(topmost)
                                                : childclass;
  const auto found = classes_.find(name);
  if (found == classes_.end()) {
    std::vector<std::string> known;
    for (const auto& [one, attributes] : classes_) known.push_back(one);
    throw core::InputError((named != nullptr ? named->where : element.where) + ": unknown class " +
                           core::in_quotes(name) + core::suggestion(name, known));
  }
  std::vector<xml::Attribute> attributes;
  const std::string own_kind = is_in(element.name, tendons) ? "tendon"
                               : kind.empty()               ? element.name
                                                            : std::string(kind);
  for (const std::string& one : {own_kind, std::string(is_actuator(element.name) ? any_actuator : "")}) {
    if (const auto own = found->second.find(one); own != found->second.end())
      attributes.insert(attributes.end(), own->second.begin(), own->second.end());
  }
  return attributes;
}

}  // namespace pbmpi::scenes::mjcf
