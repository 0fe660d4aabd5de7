/// What the studies' command lines have in common: lists of numbers and of names, counts with a least value.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "app/common/options.h"
#include "core/error.h"
#include "model/names.h"

namespace pbmpi::app {

template <class T>
auto list_of() {
  return boost::program_options::value<std::vector<T>>()->multitoken()->value_name("LIST");
}

template <class T>
std::vector<T> list(const boost::program_options::variables_map& values, const char* name,
                    std::vector<T> fallback) {
  return values.count(name) != 0 ? values[name].as<std::vector<T>>() : fallback;
}

/// Throws core::InputError for a word that is none of `names`.
template <class Enum, std::size_t N>
std::vector<Enum> choices(const boost::program_options::variables_map& values, const std::string& name,
                          const std::array<std::string_view, N>& names,
                          const std::vector<std::string>& fallback) {
  std::vector<Enum> chosen;
  std::string known;
  for (const std::string_view text : names) known.append(known.empty() ? "" : ", ").append(text);
  for (const std::string& word : list<std::string>(values, name.c_str(), fallback)) {
    const auto value = model::enum_from_name<Enum>(word, names);
    if (!value) throw core::InputError("--" + name + " " + word + ": it must be one of " + known);
    chosen.push_back(*value);
  }
  return chosen;
}

/// Throws core::InputError naming `option`.
void require_at_least(const std::vector<int>& given, int least, const char* option);

/// The number of an option without a default. Throws core::InputError if it is below `least`.
std::optional<int> given(const boost::program_options::variables_map& values, const char* name, int least);

}  // namespace pbmpi::app
