#include "core/statistics.h"

#include <algorithm>
#include <cmath>

namespace pbmpi::core {

Summary summarize(std::span<const double> values) {
  if (values.empty()) return {};
  const auto [min, max] = std::minmax_element(values.begin(), values.end());
  double sum = 0;
  for (double v : values) sum += v;
  const double n = static_cast<double>(values.size());
  const double mean = sum / n;
  double squares = 0;
  for (double v : values) squares += (v - mean) * (v - mean);
  return {*min, *max, mean, std::sqrt(squares / n)};
}

double quantile(std::vector<double> values, double q) {
  if (values.empty()) return 0;
  std::sort(values.begin(), values.end());
  const double place = q * static_cast<double>(values.size() - 1);
  const auto low = static_cast<std::size_t>(place);
  const std::size_t high = std::min(low + 1, values.size() - 1);
  return values[low] + (place - static_cast<double>(low)) * (values[high] - values[low]);
}

double harmonic_mean(std::span<const double> values) {
  double inverse_sum = 0;
  for (double v : values) {
    if (!(v > 0)) return 0;
    inverse_sum += 1 / v;
  }
  return values.empty() ? 0 : static_cast<double>(values.size()) / inverse_sum;
}

}  // namespace pbmpi::core
