/// A page for man(1).
#pragma once

#include <string>

#include "app/manual/pages/programs.h"

namespace pbmpi::app {

/// The page of a program or of one of its commands.
std::string roff_page(const Manual& manual, const ProgramManual& of);

}  // namespace pbmpi::app
