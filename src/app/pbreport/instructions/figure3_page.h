/// Figure 3 of the paper, and the mix of its section 3.3, as parts of a page and as text.
#pragma once

#include <string>
#include <vector>

#include "app/pbreport/instructions/direct_cost.h"
#include "io/html/chart_page.h"

namespace pbmpi::app {

/// `works`: for the scenes in which direct was not counted.
io::html::PageSection figure3_section(const std::vector<CountedScene>& scenes,
                                      const std::vector<IslandWork>& works);

/// One line per scene and stepper, and which numbers were extrapolated.
std::string figure3_text(const std::vector<CountedScene>& scenes, const std::vector<IslandWork>& works);

}  // namespace pbmpi::app
