#include "scenes/format/lookup.h"

#include <vector>

#include "core/error.h"
#include "core/text.h"

namespace pbmpi::scenes {
namespace {

template <class Item>
int find(const std::vector<Item>& items, const std::string& name, const std::string& where,
         const char* what) {
  std::vector<std::string> names;
  for (const Item& item : items) {
    if (item.name == name) return static_cast<int>(&item - items.data());
    names.push_back(item.name);
  }
  throw core::InputError(where + ": unknown " + what + " " + core::in_quotes(name) +
                         core::suggestion(name, names));
}

}  // namespace

int named_body(const model::Model& model, const std::string& name, const std::string& where) {
  return find(model.bodies, name, where, "body");
}

int named_joint(const model::Model& model, const std::string& name, const std::string& where) {
  return find(model.joints, name, where, "joint");
}

}  // namespace pbmpi::scenes
