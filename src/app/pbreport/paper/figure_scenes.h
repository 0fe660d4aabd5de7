/// The scenes of the paper's Figures 8 and 9 among those that were recorded.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "app/pbreport/paper/paper_data.h"

namespace pbmpi::app {

/// FigureMethod::label of the paper's estimate: quick with one iteration.
inline constexpr const char* feec_label = "FEEC quick x 1";
/// Records them.
inline constexpr const char* by_figures = "jobs/figure8_9.sh";

/// Null if it was not recorded.
const FigureScene* find_figure(const PaperData& data, const std::string& scene);

/// The scenes of Figures 8 and 9 that have all of these methods.
std::vector<const FigureScene*> scenes_with(const PaperData& data, const std::vector<std::string>& methods);

/// How much human segments are stretched, by the paper's own bounds of what an observer sees of a changed
/// length (section 2.2): below 2.7 % it cannot be seen, beyond 20 % it always is.
struct StretchCount {
  std::size_t all = 0, seen = 0;
  std::size_t perhaps_seen = 0;  ///< those that are seen included
  double most = 0;               ///< of those that are finite
};
StretchCount count_stretch(const std::vector<double>& stretch);

}  // namespace pbmpi::app
