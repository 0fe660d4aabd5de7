#include "scenes/mjcf/places.h"

#include <algorithm>

#include "core/text.h"

namespace pbmpi::scenes::mjcf {

bool are_together(const Named& a, const Named& b) {
  return std::ranges::all_of(a.copies, [&](const Copy& copy) {
    const auto same = std::ranges::find(b.copies, copy.first, &Copy::first);
    return same == b.copies.end() || same->second == copy.second;
  });
}

bool is_within(const Part& part, const Part& around) {
  const Part* at = &part;
  while (at != nullptr && at != &around) at = at->into;
  return at != nullptr;
}

bool has_named(const xml::Element& element, std::string_view kind, std::string_view name) {
  const xml::Attribute* own = element.find("name");
  if (element.name == kind && own != nullptr && own->value == name) return true;
  return std::ranges::any_of(element.children,
                             [&](const xml::Element& child) { return has_named(child, kind, name); });
}

void fail_unknown(xml::Attributes& attributes, const std::string& key, const std::string& kind,
                  const std::vector<std::string>& names) {
  const std::string name = attributes.text(key);
  attributes.fail(key, "unknown " + kind + " " + core::in_quotes(name) + core::suggestion(name, names));
}

}  // namespace pbmpi::scenes::mjcf
