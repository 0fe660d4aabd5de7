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

/// From low to high, with what probability the number sought lies between.
struct Interval {
  double low = 0, high = 0, confidence = 0;
};

/// Where the median of what `values` are a sample of lies, whatever its distribution: the narrowest pair of
/// order statistics, as far from either end, with at least `confidence`; of a sample too small for that the
/// first and the last, with less. The median is not below the k-th with the probability that of n tosses at
/// least k show heads (David and Nagaraja, Order Statistics, 2003, section 7.1). All 0 for an empty sample.
Interval median_interval(std::vector<double> values, double confidence);

/// n / sum(1 / v); 0 for an empty sample or a value <= 0.
double harmonic_mean(std::span<const double> values);

}  // namespace pbmpi::core
