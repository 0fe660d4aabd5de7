/// The recorded scenes of the paper's Figures 8 and 9.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "app/pbreport/paper/paper_data.h"

namespace pbmpi::app {

/// FigureMethod::label of the paper's estimate: quick with one iteration.
inline constexpr const char* feec_label = "FEEC quick x 1";
/// The script that records them.
inline constexpr const char* by_figures = "jobs/figure8_9.sh";

/// Null if it was not recorded.
const FigureScene* find_figure(const PaperData& data, const std::string& scene);

/// The scenes of Figures 8 and 9 that have all of these methods.
std::vector<const FigureScene*> scenes_with(const PaperData& data, const std::vector<std::string>& methods);

/// How much human segments are stretched, by the paper's own bounds for what an observer sees of a changed
/// length (section 2.2): below 2.7 % it cannot be seen, beyond 20 % it always is.
struct StretchCount {
  std::size_t all = 0, seen = 0;
  std::size_t perhaps_seen = 0;  ///< includes those that are seen
  double most = 0;               ///< of the finite ones
};
StretchCount count_stretch(const std::vector<double>& stretch);

}  // namespace pbmpi::app
