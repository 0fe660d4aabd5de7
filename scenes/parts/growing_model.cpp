#include "scenes/parts/growing_model.h"

#include <algorithm>
#include <cctype>

#include "core/error.h"
#include "core/text.h"

namespace pbmpi::scenes {
namespace {

template <class Item>
int need(std::optional<int> found, const std::vector<Item>& items, const std::string& name,
         const std::string& where, const char* what, std::string_view also = {}) {
  if (found) return *found;
  std::vector<std::string> names = names_of(items);
  if (!also.empty() && !core::nearest_name(name, {std::string(also)}).empty())
    names.emplace(names.begin(), also);
  throw core::InputError(where + ": unknown " + what + " " + core::in_quotes(name) +
                         core::suggestion(name, names));
}

bool is_number(std::string_view text) {
  return std::ranges::all_of(text, [](unsigned char c) { return std::isdigit(c) != 0; });
}

}  // namespace

int GrowingModel::named_body(const std::string& name, const std::string& where, std::string_view also) {
  return need(find_body(name), bodies, name, where, "body", also);
}

int GrowingModel::named_joint(const std::string& name, const std::string& where) {
  return need(joint_names_.find(joints, name), joints, name, where, "joint");
}

int GrowingModel::named_actor(const std::string& name, const std::string& where) {
  return need(actor_names_.find(actors, name), actors, name, where, "actor");
}

std::vector<int> GrowingModel::named_actors(const std::string& name, const std::string& where) {
  std::vector<int> found;
  for (auto at = actor_names_.from(actors, name); at != actor_names_.end() && at->first == name; ++at)
    found.push_back(at->second);
  const std::string copy = name + ".";
  for (auto at = actor_names_.from(actors, copy); at != actor_names_.end() && at->first.starts_with(copy);
       ++at) {
    if (is_number(std::string_view(at->first).substr(copy.size()))) found.push_back(at->second);
  }
  if (found.empty()) need(std::nullopt, actors, name, where, "actor");
  return found;
}

bool GrowingModel::has_body_beginning_with(const std::string& beginning) {
  const auto first = body_names_.from(bodies, beginning);
  return first != body_names_.end() && first->first.starts_with(beginning);
}

const model::Geom* GrowingModel::geom_of(int body) {
  geom_of_body_.resize(bodies.size(), -1);
  for (; num_known_geoms_ < geoms.size(); ++num_known_geoms_) {
    const int of = geoms[num_known_geoms_].body;
    if (of != model::no_body && geom_of_body_[of] < 0) geom_of_body_[of] = static_cast<int>(num_known_geoms_);
  }
  return geom_of_body_[body] < 0 ? nullptr : &geoms[geom_of_body_[body]];
}

}  // namespace pbmpi::scenes
