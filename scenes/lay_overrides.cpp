#include "scenes/scene_toml.h"

#include <algorithm>
#include <array>
#include <map>
#include <sstream>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "core/error.h"
#include "core/text.h"
#include "scenes/format/table_reader.h"

namespace pbmpi::scenes {
namespace {

constexpr std::string_view whole_world = "world";

/// The value that an override replaces.
struct Target {
  std::string_view array;         ///< "actor" or "joint"; empty: the scene itself
  std::string_view name;          ///< of the actor or joint
  std::vector<std::string> path;  ///< keys from there on; not empty
};

std::string place_of(const Override& one) {
  return one.where.empty() ? "parameter " + core::in_quotes(one.key) : one.where;
}

[[noreturn]] void refuse(const Override& one, const std::string& problem) {
  throw core::InputError(place_of(one) + ": " + problem);
}

/// What the scene has under each name, "actor" or "joint", and nothing for "world".
using Names = std::map<std::string, std::string_view, std::less<>>;

Names names_in(const toml::table& scene) {
  Names names{{std::string(whole_world), ""}};
  for (const std::string_view array : {"actor", "joint"}) {
    const toml::array* entries = scene[array].as_array();
    if (entries == nullptr) continue;
    for (const toml::node& entry : *entries) {
      const toml::table* table = entry.as_table();
      const auto name = table ? (*table)["name"].value<std::string>() : std::nullopt;
      if (name) names.emplace(*name, array);
    }
  }
  return names;
}

/// "a.b" -> {"a", "b"}
std::vector<std::string> split(const Override& one, std::string_view path) {
  std::vector<std::string> parts;
  while (true) {
    const std::size_t dot = path.find('.');
    parts.emplace_back(path.substr(0, dot));
    if (parts.back().empty())
      refuse(one, "a part of the key is missing; write ACTOR.KEY, JOINT.KEY or world.KEY");
    if (dot == std::string_view::npos) return parts;
    path.remove_prefix(dot + 1);
  }
}

/// Refuses keys that have one value for all worlds of a run, and arrays, whose elements are addressed by
/// name.
void require_of_a_world(const Override& one, const std::string& key) {
  constexpr std::array common = {"title", "base", "spaces", "run", "case"};
  if (std::ranges::find(common, key) != common.end())
    refuse(one, core::in_quotes(key) + " is the same for all worlds of a run; change it in the scene");
  constexpr std::array arrays = {"actor", "joint"};
  if (std::ranges::find(arrays, key) != arrays.end())
    refuse(one, "write the name of the " + key + " instead of world." + key + ", as in NAME.KEY");
  constexpr std::array nameless = {"pair", "event"};
  if (std::ranges::find(nameless, key) != nameless.end())
    refuse(one, "a [[" + key + "]] has no name by which a world could have it otherwise");
}

Target target_of(const Override& one, const Names& names) {
  const std::string_view key = one.key;
  // A name may itself contain a dot: among the names that the key begins with, the longest is meant.
  for (std::size_t dot = key.rfind('.'); dot != std::string_view::npos && dot > 0;
       dot = key.rfind('.', dot - 1)) {
    const auto found = names.find(key.substr(0, dot));
    if (found == names.end()) continue;
    Target target{found->second, found->first, split(one, key.substr(dot + 1))};
    if (target.array.empty())
      require_of_a_world(one, target.path.front());
    else if (target.path.front() == "name")
      refuse(one, "a name is what the other keys go by; it stays");
    return target;
  }
  const std::string first(key.substr(0, key.find('.')));
  if (names.contains(first))
    refuse(one, "there is no key behind " + core::in_quotes(first) + "; write " + first + ".KEY");
  std::vector<std::string> known;
  for (const auto& [name, array] : names) known.push_back(name);
  refuse(one, "the scene has no actor or joint " + core::in_quotes(first) + core::suggestion(first, known));
}

/// Refuses a text that is not exactly one value.
void require_value(const Override& one) {
  try {
    if (toml::parse("value = " + one.value).size() == 1) return;
  } catch (const toml::parse_error& error) {
    refuse(one, core::in_quotes(one.value) + " is no TOML value (" + std::string(error.description()) +
                    "); write a number, true, \"text\" or [1, 2]");
  }
  refuse(one, core::in_quotes(one.value) + " is more than one TOML value");
}

/// The scene file that would give this value if it had this scene as its base.
toml::table file_of(const Override& one, const Target& target) {
  std::string text;
  if (!target.array.empty())
    text = "[[" + std::string(target.array) + "]]\nname = " + toml_string(target.name) + "\n";
  for (std::size_t i = 0; i < target.path.size(); ++i)
    text += (i == 0 ? "" : ".") + toml_string(target.path[i]);
  return parse_text({"", place_mark + place_of(one), text + " = " + one.value});
}

}  // namespace

std::string toml_text(const toml::node& value) {
  using toml::format_flags;
  constexpr format_flags flags = toml::toml_formatter::default_flags &
                                 ~(format_flags::indentation | format_flags::allow_literal_strings |
                                   format_flags::allow_multi_line_strings);
  std::ostringstream text;
  value.visit([&](const auto& one) { text << toml::toml_formatter{one, flags}; });
  return text.str();
}

std::string toml_string(std::string_view text) { return toml_text(toml::value<std::string>(text)); }

void lay_overrides(toml::table& scene, const Overrides& overrides) {
  const Names names = names_in(scene);
  for (const Override& one : overrides) {
    const Target target = target_of(one, names);
    require_value(one);
    lay_over(scene, file_of(one, target));
  }
}

}  // namespace pbmpi::scenes
