/// "pbreport paper FOLDER|FILE...": every statement of the paper beside the measurements of jobs/paper.sh.
#pragma once

#include <iosfwd>
#include <string>
#include <vector>

#include "app/manual/manual.h"
#include "core/error.h"

namespace pbmpi::app {

/// Throws core::InputError: bad usage, or files that are of no use here.
core::ExitCode run_paper(const std::vector<std::string>& args, std::ostream& out);
Manual paper_manual();

}  // namespace pbmpi::app
