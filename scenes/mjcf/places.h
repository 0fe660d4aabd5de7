/// Where the parts of a model stand that its other elements name.
#pragma once

#include <deque>
#include <string>
#include <utility>
#include <vector>

#include "scenes/links/links.h"
#include "scenes/mjcf/attachments.h"
#include "scenes/parts/name_index.h"

namespace pbmpi::scenes::mjcf {

/// One of the copies that a `<replicate>` makes: the element and the number of the copy.
using Copy = std::pair<const xml::Element*, int>;

/// A named thing, which a file may have several times: a name then means all of them, and what connects two
/// of them connects those of one copy, as MuJoCo repeats what names copies.
struct Named {
  std::string name;    ///< as in its file, with the prefix of its part
  std::string suffix;  ///< of its copy
  const Part* part = nullptr;
  std::vector<Copy> copies;  ///< in which it stands, outermost first
};

/// Are the two in the same copy of each `<replicate>` that has both?
bool are_together(const Named& a, const Named& b);

struct BodyPlace : Named {
  int link = 0;
};

struct JointPlace : Named {
  int link = 0, joint = 0;
  double most_servo_force = model::infinity;  ///< as in ReadJoint
};

struct SitePlace : Named {
  int link = 0;
  Pose frame;  ///< of the elements around it, in the link's frame
  const xml::Element* element = nullptr;
  std::string childclass;
};

struct GeomPlace : Named {
  int link = 0, geom = 0;
};

struct Places {
  std::vector<BodyPlace> bodies;   ///< the world first
  std::vector<JointPlace> joints;  ///< in the order of MuJoCo's qpos
  std::vector<SitePlace> sites;
  std::vector<GeomPlace> geoms;
  std::vector<int> mocap_links;  ///< in the order of MuJoCo's mpos
};

/// Finds the things of one kind that a name means: in a part those of the part, and with their prefixes those
/// of the parts in it; in the main part also single copies, by their whole names. The list is borrowed, and
/// no longer grows.
template <class Place>
class PlaceIndex {
 public:
  /// `kind`: the name of the elements, for messages.
  PlaceIndex(const std::vector<Place>& places, std::string kind) : places_(places), kind_(std::move(kind)) {}

  /// Those that the attribute `key` of an element of `part` names; none if it names what has not been
  /// attached with the part. Throws core::InputError for an unknown name.
  std::vector<const Place*> find(xml::Attributes& attributes, const std::string& key, const Part& part);

 private:
  struct WholeName {
    std::string name;
  };
  const std::vector<Place>& places_;
  std::string kind_;
  NameIndex names_, whole_name_index_;
  std::vector<WholeName> whole_names_;  ///< none until a name is not found without its suffix
};

/// Is the part, or one that it is attached into, `around`?
bool is_within(const Part& part, const Part& around);

/// Has the element, or one below it, this name and kind?
bool has_named(const xml::Element& element, std::string_view kind, std::string_view name);
/// Refuses an unknown name.
[[noreturn]] void fail_unknown(xml::Attributes& attributes, const std::string& key, const std::string& kind,
                               const std::vector<std::string>& names);

template <class Place>
std::vector<const Place*> PlaceIndex<Place>::find(xml::Attributes& attributes, const std::string& key,
                                                  const Part& part) {
  const std::string own_name = attributes.text(key);
  if (kind_ == "body" && own_name == "world") return {&places_.front()};
  const std::string name = part.prefix + own_name;
  std::vector<const Place*> found;
  for (auto at = names_.from(places_, name); at != names_.end() && at->first == name; ++at) {
    const Place& place = places_[static_cast<std::size_t>(at->second)];
    if (is_within(*place.part, part)) found.push_back(&place);
  }
  const bool is_main = part.into == nullptr;
  if (found.empty() && is_main) {
    if (whole_names_.empty()) {
      for (const Place& place : places_) whole_names_.push_back({place.name + place.suffix});
    }
    if (const auto at = whole_name_index_.find(whole_names_, name))
      found.push_back(&places_[static_cast<std::size_t>(*at)]);
  }
  if (found.empty() && (is_main || !has_named(*part.root, kind_, own_name)))
    fail_unknown(attributes, key, kind_, names_of(places_));
  return found;
}

}  // namespace pbmpi::scenes::mjcf
