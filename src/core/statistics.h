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

/// An interval, and the probability that it contains the wanted number.
struct Interval {
  double low = 0, high = 0, confidence = 0;
};

/// An interval for the median of the distribution, of any shape, from which `values` are a sample: the
/// narrowest pair of order statistics, equally far from either end, with at least `confidence`; for a sample
/// too small for that the first and the last, with less. The median is not below the k-th value with the
/// probability that at least k of n tosses show heads (David and Nagaraja, Order Statistics, 2003, section
/// 7.1). All 0 for an empty sample.
Interval median_interval(std::vector<double> values, double confidence);

/// n / sum(1 / v); 0 for an empty sample or a value <= 0.
double harmonic_mean(std::span<const double> values);

}  // namespace pbmpi::core
