/// What shells complete: commands, options, and the values that offered_values() knows.
#pragma once

#include <string>

#include "app/manual/pages/programs.h"

namespace pbmpi::app {

std::string bash_completion(const ProgramManual& program);
std::string zsh_completion(const ProgramManual& program);
std::string fish_completion(const ProgramManual& program);

}  // namespace pbmpi::app
