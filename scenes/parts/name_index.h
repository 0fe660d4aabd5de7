/// Finds the items of a list by name.
#pragma once

#include <functional>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace pbmpi::scenes {

/// The names of all items, in their order.
template <class Item>
std::vector<std::string> names_of(const std::vector<Item>& items) {
  std::vector<std::string> names;
  names.reserve(items.size());
  for (const Item& item : items) names.push_back(item.name);
  return names;
}

/// Where the names of a list stand that only grows. Each look-up takes up what has been added since the last.
class NameIndex {
 public:
  /// Index of the first item of that name; nothing without one.
  template <class Item>
  std::optional<int> find(const std::vector<Item>& items, std::string_view name) {
    const auto found = from(items, name);
    if (found == at_.end() || found->first != name) return std::nullopt;
    return found->second;
  }

  /// The names from `beginning` on, in alphabetical order; end() follows the last name of all.
  template <class Item>
  std::multimap<std::string, int>::const_iterator from(const std::vector<Item>& items,
                                                       std::string_view beginning) {
    for (; num_known_ < items.size(); ++num_known_)
      at_.emplace(items[num_known_].name, static_cast<int>(num_known_));
    return at_.lower_bound(beginning);
  }
  auto end() const { return at_.end(); }

 private:
  std::multimap<std::string, int, std::less<>> at_;
  std::size_t num_known_ = 0;
};

}  // namespace pbmpi::scenes
