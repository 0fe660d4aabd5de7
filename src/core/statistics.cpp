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

Interval median_interval(std::vector<double> values, double confidence) {
  if (values.empty()) return {};
  std::sort(values.begin(), values.end());
  const std::size_t n = values.size();
  double probability = 1;  // of exactly k heads, over 2^exponent: undivided it may be below every double
  int exponent = -static_cast<int>(n);
  Interval found;
  double outside = 0;  // the median is below the k-th value from the bottom, or above the k-th from the top
  for (std::size_t k = 0; 2 * k < n; ++k) {
    outside += 2 * std::ldexp(probability, exponent);
    if (k > 0 && 1 - outside < confidence) break;
    found = {values[k], values[n - 1 - k], std::max(0.0, 1 - outside)};
    int raised = 0;
    probability = std::frexp(probability * static_cast<double>(n - k) / static_cast<double>(k + 1), &raised);
    exponent += raised;
  }
  return found;
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
