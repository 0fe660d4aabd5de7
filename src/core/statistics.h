/// Order statistics and means over a sample.
#pragma once

#include <span>
#include <vector>

namespace pbmpi::core {

struct Summary {
  double min = 0, max = 0, mean = 0, stddev = 0;  ///< stddev is the population's (divided by n)
};

/// All zero for an empty sample.
Summary summarize(std::span<const double> values);

/// The q-quantile (0 <= q <= 1) with linear interpolation between order statistics; 0 for an empty sample.
double quantile(std::vector<double> values, double q);

/// n / sum(1 / v); 0 for an empty sample or a value <= 0.
double harmonic_mean(std::span<const double> values);

}  // namespace pbmpi::core
