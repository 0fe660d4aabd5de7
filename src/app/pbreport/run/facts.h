/// The numbers at the head of the HTML page.
#pragma once

#include <vector>

#include "app/summary/run_summary.h"
#include "io/html/page.h"

namespace pbmpi::app {

std::vector<io::html::Fact> facts_of(const RunSummary& summary);

}  // namespace pbmpi::app
