#include "app/pbreport/scaling/scaling_curves.h"

#include <algorithm>
#include <map>
#include <numeric>
#include <set>
#include <tuple>

#include "app/common/format.h"

namespace pbmpi::app {
namespace {

constexpr double confidence = 0.95;

/// Runs of one problem, which differ only in the numbers of worlds and ranks.
using Series = std::vector<const ScalingRun*>;

std::vector<Series> series_of(const std::vector<ScalingRun>& runs) {
  std::vector<Series> series;
  for (const ScalingRun& run : runs) {
    const auto found =
        std::ranges::find_if(series, [&](const Series& one) { return one.front()->problem == run.problem; });
    if (found == series.end()) {
      series.push_back({&run});
    } else {
      found->push_back(&run);
    }
  }
  for (Series& one : series) {
    std::ranges::stable_sort(one, [](const ScalingRun* a, const ScalingRun* b) {
      return std::tie(a->created, a->path) < std::tie(b->created, b->path);
    });
  }
  return series;
}

/// Points by ascending ranks. Excludes runs that recorded islands, which do more in a frame.
std::vector<ScalingPoint> points_of(const Series& series) {
  std::vector<ScalingPoint> points;
  for (const ScalingRun* run : series) {
    if (run->records_islands) continue;
    const auto found = std::ranges::find_if(points, [&](const ScalingPoint& point) {
      return std::tie(point.ranks, point.worlds, point.decomposition) ==
             std::tie(run->ranks, run->worlds, run->decomposition);
    });
    if (found == points.end()) {
      points.push_back({run->ranks, run->worlds, run->decomposition, {run}, {}, {}, 1, {}});
    } else {
      found->runs.push_back(run);
    }
  }
  std::ranges::sort(points, {}, [](const ScalingPoint& point) {
    return std::tie(point.ranks, point.worlds, point.decomposition);
  });
  return points;
}

double worlds_per_s(const ScalingRun& run) { return run.worlds / run.frame_s; }

Estimated estimated(const std::vector<double>& sample) {
  return {core::quantile(sample, 0.5), core::median_interval(sample, confidence)};
}

Estimated scaled(const Estimated& value, double factor) {
  const core::Interval& interval = value.interval;
  return {value.median * factor, {interval.low * factor, interval.high * factor, interval.confidence}};
}

void compare(const ScalingPoint& base, ScalingPoint& point) {
  std::vector<double> ratios;
  for (std::size_t k = 0; k < std::min(base.runs.size(), point.runs.size()); ++k)
    ratios.push_back(worlds_per_s(*point.runs[k]) / worlds_per_s(*base.runs[k]));
  point.speed_up = estimated(ratios);
  point.efficiency = scaled(point.speed_up, static_cast<double>(base.ranks) / point.ranks);
  const double base_useful_s = base.median_of(&ScalingRun::useful_s) / base.worlds;
  const double useful_s = point.median_of(&ScalingRun::useful_s) / point.worlds;
  point.computation = useful_s > 0 ? base_useful_s / useful_s : 0;
}

std::vector<std::string> doubts_of(const ScalingPoint& point, const ScalingPoint& base,
                                   const std::set<std::string>& hashes, const ScalingRules& rules) {
  std::vector<std::string> doubts;
  const std::size_t repeats = std::min(point.runs.size(), base.runs.size());
  if (repeats < static_cast<std::size_t>(rules.least_repeats))
    doubts.push_back(format("%zu of %d repeats", repeats, rules.least_repeats));
  const core::Interval& interval = point.speed_up.interval;
  const double width = (interval.high - interval.low) / point.speed_up.median;
  if (!(width <= rules.widest_interval))
    doubts.push_back(
        format("interval of %.0f %%, %.0f %% at most", 100 * width, 100 * rules.widest_interval));
  if (hashes.size() > 1) doubts.push_back(format("%zu different hashes", hashes.size()));
  // A ratio is no better than the base runs in its denominator.
  const auto any_run = [&](const auto& predicate) {
    const auto holds = [&](const ScalingRun* run) { return predicate(*run); };
    return std::ranges::any_of(point.runs, holds) || std::ranges::any_of(base.runs, holds);
  };
  const std::string& program = base.runs.front()->program;
  if (any_run([&](const ScalingRun& run) { return run.program != program; }))
    doubts.emplace_back("another build or processor than the base's");
  if (any_run([](const ScalingRun& run) { return !run.complete; }))
    doubts.emplace_back("a run that did not end");
  if (any_run([](const ScalingRun& run) {
        return run.processors > 0 && run.most_ranks_of_a_host > run.processors;
      }))
    doubts.emplace_back("more ranks than processors");
  return doubts;
}

/// State hashes of all runs of a series with this number of worlds.
std::set<std::string> hashes_of(const Series& series, int worlds) {
  std::set<std::string> hashes;
  for (const ScalingRun* run : series) {
    if (run->worlds == worlds && run->complete) hashes.insert(run->state_hash);
  }
  return hashes;
}

bool has_several_ranks(const std::vector<ScalingPoint>& points) {
  return points.front().ranks != points.back().ranks;
}

/// The fastest point on the fewest ranks; these come first.
const ScalingPoint& base_of(const std::vector<ScalingPoint>& points) {
  const ScalingPoint* best = &points.front();
  for (const ScalingPoint& point : points) {
    if (point.ranks == best->ranks &&
        point.median_of(&ScalingRun::frame_s) < best->median_of(&ScalingRun::frame_s))
      best = &point;
  }
  return *best;
}

std::optional<Figure6Bars> figure6_of(const ScalingCurve& curve, const std::vector<ScalingRun>& runs) {
  const auto found = std::ranges::find_if(runs, [&](const ScalingRun& run) {
    return run.records_islands && run.ranks == 1 && run.scene == curve.first->scene &&
           run.worlds == curve.first->worlds;
  });
  if (found == runs.end() || curve.kind != ScalingKind::strong) return std::nullopt;
  return read_figure6_bars(*found);
}

/// `points`: by ascending ranks, including the base.
ScalingCurve curve_of(ScalingKind kind, const std::string& decomposition, const Series& series,
                      std::vector<ScalingPoint> points, const ScalingPoint& base, const ScalingRules& rules) {
  ScalingCurve curve;
  curve.kind = kind;
  curve.decomposition = decomposition;
  curve.first = base.runs.front();
  for (ScalingPoint& point : points) {
    compare(base, point);
    point.doubts = doubts_of(point, base, hashes_of(series, point.worlds), rules);
  }
  curve.points = std::move(points);
  const auto at = std::ranges::find_if(
      curve.points, [&](const ScalingPoint& point) { return point.runs.front() == base.runs.front(); });
  curve.base = static_cast<std::size_t>(at - curve.points.begin());
  return curve;
}

template <class Belongs>
std::vector<ScalingPoint> chosen(const std::vector<ScalingPoint>& points, const Belongs& belongs) {
  std::vector<ScalingPoint> found;
  std::ranges::copy_if(points, std::back_inserter(found), belongs);
  return found;
}

/// Adds one curve per number of worlds and decomposition.
void add_strong(const Series& series, const std::vector<ScalingPoint>& points, const ScalingRules& rules,
                std::vector<ScalingCurve>& curves) {
  std::set<std::pair<int, std::string>> keys;
  for (const ScalingPoint& point : points) keys.emplace(point.worlds, point.decomposition);
  for (const auto& [worlds, decomposition] : keys) {
    const auto same_work =
        chosen(points, [&, count = worlds](const ScalingPoint& point) { return point.worlds == count; });
    const ScalingPoint& base = base_of(same_work);
    const auto on_curve = chosen(same_work, [&, &way = decomposition](const ScalingPoint& point) {
      return point.decomposition == way || point.ranks == base.ranks;
    });
    if (!has_several_ranks(on_curve)) continue;
    curves.push_back(curve_of(ScalingKind::strong, decomposition, series, on_curve, base, rules));
  }
}

/// Adds one curve per number of worlds a rank; a world that is cut does not grow with the ranks.
void add_weak(const Series& series, const std::vector<ScalingPoint>& points, const ScalingRules& rules,
              std::vector<ScalingCurve>& curves) {
  std::map<std::pair<int, int>, std::vector<ScalingPoint>> by_load;
  for (const ScalingPoint& point : points) {
    const int common = std::gcd(point.worlds, point.ranks);
    if (point.decomposition == "worlds")
      by_load[{point.worlds / common, point.ranks / common}].push_back(point);
  }
  for (const auto& [load, on_curve] : by_load) {
    if (has_several_ranks(on_curve))
      curves.push_back(curve_of(ScalingKind::weak, "worlds", series, on_curve, on_curve.front(), rules));
  }
}

template <class Value>
double median(const std::vector<const ScalingRun*>& runs, const Value& value) {
  std::vector<double> values;
  values.reserve(runs.size());
  for (const ScalingRun* run : runs) values.push_back(value(*run));
  return core::quantile(values, 0.5);
}

}  // namespace

double ScalingPoint::median_of(double ScalingRun::*value) const {
  return median(runs, [&](const ScalingRun& run) { return run.*value; });
}

double ScalingPoint::median_of(double PopEfficiencies::*value) const {
  return median(runs, [&](const ScalingRun& run) { return run.pop.*value; });
}

std::vector<ScalingCurve> curves_of(const std::vector<ScalingRun>& runs, const ScalingRules& rules) {
  std::vector<ScalingCurve> curves;
  for (const Series& series : series_of(runs)) {
    const std::vector<ScalingPoint> points = points_of(series);
    if (points.empty()) continue;
    add_strong(series, points, rules, curves);
    add_weak(series, points, rules, curves);
  }
  std::ranges::stable_sort(curves, {}, &ScalingCurve::kind);
  for (ScalingCurve& curve : curves) curve.figure6 = figure6_of(curve, runs);
  return curves;
}

std::vector<std::string> files_without_curve(const std::vector<ScalingRun>& runs,
                                             const std::vector<ScalingCurve>& curves) {
  std::set<const ScalingRun*> used;
  for (const ScalingCurve& curve : curves) {
    for (const ScalingPoint& point : curve.points) used.insert(point.runs.begin(), point.runs.end());
  }
  std::vector<std::string> files;
  for (const ScalingRun& run : runs) {
    if (!used.contains(&run) && !run.records_islands) files.push_back(run.path);
  }
  return files;
}

}  // namespace pbmpi::app
