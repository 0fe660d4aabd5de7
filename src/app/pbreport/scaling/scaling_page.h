/// Curves of scaling as an HTML page.
#pragma once

#include <string>
#include <vector>

#include "app/pbreport/scaling/scaling_curves.h"

namespace pbmpi::app {

/// Throws core::InputError if it cannot be written.
void write_scaling_page(const std::string& path, const std::vector<ScalingRun>& runs,
                        const std::vector<ScalingCurve>& curves);

}  // namespace pbmpi::app
