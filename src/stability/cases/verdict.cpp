#include "stability/cases/verdict.h"

#include <cmath>

namespace pbmpi::stability {
namespace {

constexpr std::array<std::string_view, quantity_names.size()> quantity_units = {
    "m", "m", "m", "m/s", "m/s", "m/s", "m/s", "m", "rad"};

/// How far a number exceeds its limit for right: 1 at the limit.
double excess(double value, const Limits& limits) {
  if (std::isnan(value)) return INFINITY;
  if (limits.right > 0) return value / limits.right;
  return value > 0 ? INFINITY : 0;
}

bool is_worse(const Judgement& a, const Judgement& b) {
  if (a.verdict != b.verdict) return a.verdict > b.verdict;
  return excess(a.value, a.limits) > excess(b.value, b.limits);
}

}  // namespace

Verdict verdict_of(double value, const Limits& limits) {
  if (value <= limits.right) return Verdict::pass;
  return value <= limits.broken ? Verdict::degraded : Verdict::broken;
}

Judgement judge(const HardCase& hard_case, const CaseMeasurement& measured) {
  std::vector<Judgement> all;
  const auto add = [&](std::string name, double value, const Limits& limits, std::string_view unit) {
    all.push_back({verdict_of(value, limits), std::move(name), value, limits, std::string(unit)});
  };
  const auto add_metric = [&](Metric metric, const Limits& limits) {
    const auto i = static_cast<std::size_t>(metric);
    add(std::string(metric_table[i].name), measured.metrics[i], limits, metric_table[i].unit);
  };
  for (const Bound& bound : hard_case.bounds) add_metric(bound.metric, bound.limits);
  for (std::size_t i = 0; i < hard_case.expectations.size(); ++i) {
    const Expectation& expected = hard_case.expectations[i];
    const auto quantity = static_cast<std::size_t>(expected.quantity);
    add(expected.body + "." + std::string(quantity_names[quantity]), measured.expected_off[i],
        expected.off_by, quantity_units[quantity]);
  }
  add_metric(Metric::nonfinite, {0, 0});
  Judgement worst = all.front();
  for (const Judgement& one : all) {
    if (is_worse(one, worst)) worst = one;
  }
  return worst;
}

}  // namespace pbmpi::stability
