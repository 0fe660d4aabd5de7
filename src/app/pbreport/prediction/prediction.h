/// "pbreport prediction": the file of pbstudy prediction.
#pragma once

#include <iosfwd>
#include <string>
#include <vector>

#include "app/manual/manual.h"
#include "core/error.h"

namespace pbmpi::app {

/// Throws core::InputError and core::RunError.
core::ExitCode run_prediction_report(const std::vector<std::string>& args, std::ostream& out);
Manual prediction_report_manual();

}  // namespace pbmpi::app
