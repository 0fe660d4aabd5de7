/// The numbers behind the page's plots.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "io/run/run_data.h"

namespace pbmpi::io::html {

/// More frames than this are drawn in bins of several frames.
inline constexpr std::size_t max_plot_points = 2000;

/// One observable over the frames: the sum over the worlds, and the smallest, mean and largest value of a
/// world. A bin of several frames has the smallest `min`, the largest `max`, and the means of the others.
struct Band {
  std::vector<double> sum, min, mean, max;  ///< [bins]
};

/// `per_bin` frames per bin; the last bin may have fewer. Empty for an empty table.
Band band_of(const Table& table, std::size_t per_bin);

/// The largest value of each bin: a spike must not vanish in a mean.
std::vector<double> largest_of_bins(const std::vector<double>& values, std::size_t per_bin);

/// Lengths of a vector observable, [T][W].
Table lengths_of(const VectorTable& table);

/// JSON of all plots, for io/html/plots.js.
std::string plots_json(const RunData& run, double budget_s);

}  // namespace pbmpi::io::html
