#include "core/text.h"

#include <algorithm>
#include <cctype>
#include <numeric>

namespace pbmpi::core {
namespace {

std::string lower(std::string_view text) {
  std::string result(text);
  for (char& c : result) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return result;
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

std::string nearest_name(std::string_view word, const std::vector<std::string>& names) {
  const std::string wanted = lower(word);
  std::string best;
  int best_distance = 0;
  for (const std::string& name : names) {
    const std::string candidate = lower(name);
    const bool prefix =
        wanted.size() >= 3 && (candidate.starts_with(wanted) || wanted.starts_with(candidate));
    const int distance = prefix ? 0 : edit_distance(wanted, candidate);
    const auto longer = static_cast<int>(std::max(wanted.size(), candidate.size()));
    if (3 * distance <= longer && (best.empty() || distance < best_distance)) {
      best = name;
      best_distance = distance;
    }
  }
  return best;
}

}  // namespace pbmpi::core
