/// Figures 8 and 9 as a page.
#pragma once

#include <string>
#include <vector>

#include "app/pbreport/figures/figures_data.h"
#include "io/html/chart_page.h"

namespace pbmpi::app {

io::html::ChartPage figures_page(const std::vector<FigureScene>& scenes);

/// Labels of the methods of all scenes, in order of appearance.
std::vector<std::string> method_labels(const std::vector<FigureScene>& scenes);

/// Mean over the scenes of FigureScene::ratio for the estimate of this label; 0 if no scene has it.
double mean_ratio(const std::vector<FigureScene>& scenes, const std::string& label);

}  // namespace pbmpi::app
