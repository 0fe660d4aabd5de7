/// The paper's statements beside the measurements, as a page.
#pragma once

#include <vector>

#include "app/pbreport/paper/statements.h"
#include "io/html/chart_page.h"

namespace pbmpi::app {

io::html::ChartPage paper_page(const std::vector<Chapter>& chapters, const PaperData& data);

}  // namespace pbmpi::app
