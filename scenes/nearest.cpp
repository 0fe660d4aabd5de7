#include "scenes/nearest.h"

#include <algorithm>
#include <cctype>

#include "core/text.h"

namespace pbmpi::scenes {
namespace {

std::string lower(std::string_view text) {
  std::string result(text);
  for (char& c : result) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return result;
}

std::string quoted_list(const std::vector<std::string>& names, const std::string& last_separator) {
  std::string list;
  for (std::size_t i = 0; i < names.size(); ++i) {
    if (i > 0) list += i + 1 == names.size() ? last_separator : ", ";
    list += in_quotes(names[i]);
  }
  return list;
}

}  // namespace

std::string in_quotes(std::string_view text) {
  std::string result(1, '\'');
  result.append(text);
  result.push_back('\'');
  return result;
}

std::vector<std::string> nearest_names(std::string_view name, const std::vector<std::string>& names) {
  // A third of the letters, but at least two, may be wrong.
  const int threshold = std::max(2, static_cast<int>(name.size()) / 3);
  std::vector<std::pair<int, std::string>> near;
  for (const std::string& candidate : names) {
    const int distance = core::edit_distance(lower(name), lower(candidate));
    const bool shares_letters = distance < static_cast<int>(std::max(name.size(), candidate.size()));
    if (distance <= threshold && shares_letters) near.emplace_back(distance, candidate);
  }
  std::stable_sort(near.begin(), near.end(), [](const auto& x, const auto& y) { return x.first < y.first; });
  std::vector<std::string> result;
  for (std::size_t i = 0; i < std::min<std::size_t>(3, near.size()); ++i) result.push_back(near[i].second);
  return result;
}

std::string suggestion(std::string_view name, const std::vector<std::string>& names) {
  const std::vector<std::string> near = nearest_names(name, names);
  if (!near.empty()) return "; did you mean " + quoted_list(near, " or ") + "?";
  if (names.empty()) return "; there are none";
  return "; known: " + quoted_list(names, ", ");
}

}  // namespace pbmpi::scenes
