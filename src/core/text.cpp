#include "core/text.h"

#include <algorithm>
#include <cctype>
#include <numeric>
#include <optional>
#include <utility>

namespace pbmpi::core {
namespace {

std::string lower(std::string_view text) {
  std::string result(text);
  for (char& c : result) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return result;
}

/// Edit distance of a word from the name that it may be meant for; empty if it is too far. Both in lower
/// case.
std::optional<int> slip(const std::string& word, const std::string& name) {
  const std::size_t shorter = std::min(word.size(), name.size()), longer = std::max(word.size(), name.size());
  if (shorter >= 3 && (name.starts_with(word) || word.starts_with(name))) return 0;
  const int distance = edit_distance(word, name);
  const int most = std::max(2, static_cast<int>(longer / 3));
  const bool shares_letters = distance < static_cast<int>(longer);
  return distance <= most && shares_letters ? std::optional(distance) : std::nullopt;
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

int edit_distance(std::string_view a, std::string_view b) {
  std::vector<int> row(b.size() + 1);
  std::iota(row.begin(), row.end(), 0);
  for (std::size_t i = 0; i < a.size(); ++i) {
    int diagonal = row.front();
    row.front() = static_cast<int>(i) + 1;
    for (std::size_t j = 0; j < b.size(); ++j) {
      const int replaced = diagonal + (a[i] == b[j] ? 0 : 1);
      diagonal = row[j + 1];
      row[j + 1] = std::min({replaced, row[j] + 1, row[j + 1] + 1});
    }
  }
  return row.back();
}

std::vector<std::string> nearest_names(std::string_view word, const std::vector<std::string>& names) {
  std::vector<std::pair<int, std::string>> near;
  for (const std::string& name : names) {
    if (const auto distance = slip(lower(word), lower(name))) near.emplace_back(*distance, name);
  }
  std::stable_sort(near.begin(), near.end(), [](const auto& x, const auto& y) { return x.first < y.first; });
  std::vector<std::string> result;
  for (std::size_t i = 0; i < std::min<std::size_t>(3, near.size()); ++i) result.push_back(near[i].second);
  return result;
}

std::string nearest_name(std::string_view word, const std::vector<std::string>& names) {
  const std::vector<std::string> near = nearest_names(word, names);
  return near.empty() ? "" : near.front();
}

std::string in_quotes(std::string_view text) {
  std::string result(1, '\'');
  result.append(text);
  result.push_back('\'');
  return result;
}

std::string suggestion(std::string_view word, const std::vector<std::string>& names) {
  const std::vector<std::string> near = nearest_names(word, names);
  if (!near.empty()) return "; did you mean " + quoted_list(near, " or ") + "?";
  if (names.empty()) return "; there are none";
  return "; known: " + quoted_list(names, ", ");
}

std::string value_in(const std::map<std::string, std::string>& values, const std::string& name) {
  const auto found = values.find(name);
  return found == values.end() ? "" : found->second;
}

}  // namespace pbmpi::core
