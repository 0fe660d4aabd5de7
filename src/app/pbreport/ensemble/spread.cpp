#include "app/pbreport/ensemble/spread.h"

#include <cmath>
#include <limits>

#include "core/statistics.h"

namespace pbmpi::app {

Spread spread_of(const std::vector<double>& samples, const std::vector<double>& quantiles) {
  constexpr double unknown = std::numeric_limits<double>::quiet_NaN();
  std::vector<double> finite;
  for (const double sample : samples) {
    if (std::isfinite(sample)) finite.push_back(sample);
  }
  Spread spread;
  spread.count = std::ssize(finite);
  spread.nonfinite = std::ssize(samples) - spread.count;
  const core::Summary all = core::summarize(finite);
  const auto n = static_cast<double>(spread.count);
  spread.mean = n > 0 ? all.mean : unknown;
  spread.min = n > 0 ? all.min : unknown;
  spread.max = n > 0 ? all.max : unknown;
  spread.stddev = n > 1 ? all.stddev * std::sqrt(n / (n - 1)) : unknown;
  for (const double q : quantiles) spread.quantiles.push_back(n > 0 ? core::quantile(finite, q) : unknown);
  return spread;
}

}  // namespace pbmpi::app
