/// The values that a shell offers for an option.
#pragma once

#include <string>
#include <vector>

#include "app/manual/pages/option_table.h"

namespace pbmpi::app {

struct OfferedValues {
  std::vector<std::string> words;
  bool files = false, folders = false;
};

/// The words of a placeholder that lists them ("quick|direct|sor"), also where a study varies a step option;
/// the scenes that pbmpi brings; the effects; files, folders; or nothing.
OfferedValues offered_values(const OptionRow& option);

}  // namespace pbmpi::app
