/// What the studies' command lines share: lists, and counts with a least value.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "app/common/options.h"
#include "core/error.h"

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

/// Throws core::InputError naming `option`.
void require_at_least(const std::vector<int>& given, int least, const char* option);

/// The number of an option without a default. Throws core::InputError if it is below `least`.
std::optional<int> given(const boost::program_options::variables_map& values, const char* name, int least);

}  // namespace pbmpi::app
