/// "pbreport calibrate": the cost of the harness, and what it means for more ranks than are available.
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
