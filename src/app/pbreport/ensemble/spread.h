/// The spread of a number's samples.
#pragma once

#include <cstdint>
#include <vector>

namespace pbmpi::app {

/// Over the finite samples. NaN with too few of them: mean and quantiles need one, stddev two.
struct Spread {
  std::int64_t count = 0;       ///< finite samples
  std::int64_t nonfinite = 0;   ///< the others
  double mean = 0, stddev = 0;  ///< stddev is the sample's (divided by count - 1)
  double min = 0, max = 0;
  std::vector<double> quantiles;  ///< in the order asked for, linear between order statistics
};

/// `quantiles`: from 0 to 1.
Spread spread_of(const std::vector<double>& samples, const std::vector<double>& quantiles);

}  // namespace pbmpi::app
