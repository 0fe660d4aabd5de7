/// "pbreport calibrate": what the harness costs, and what that means on more ranks than there are.
#pragma once

#include <ostream>
#include <string>
#include <vector>

#include "app/manual/manual.h"
#include "core/error.h"

namespace pbmpi::app {

core::ExitCode run_calibrate_report(const std::vector<std::string>& args, std::ostream& out);

Manual calibrate_report_manual();

}  // namespace pbmpi::app
