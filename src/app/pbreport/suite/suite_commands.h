/// "pbreport islands|cores|figure6 FILE...": the paper's characterisation of scenes beside its own numbers.
#pragma once

#include <iosfwd>
#include <string>
#include <vector>

#include "app/manual/manual.h"
#include "core/error.h"

namespace pbmpi::app {

/// Table 1. Throws core::InputError, like the others.
core::ExitCode run_islands(const std::vector<std::string>& args, std::ostream& out);
/// Table 2, and the frame rates of Figure 6.
core::ExitCode run_cores(const std::vector<std::string>& args, std::ostream& out);
/// One page with Figure 6, both tables and stills.
core::ExitCode run_figure6(const std::vector<std::string>& args, std::ostream& out);
Manual islands_manual();
Manual cores_manual();
Manual figure6_manual();

}  // namespace pbmpi::app
