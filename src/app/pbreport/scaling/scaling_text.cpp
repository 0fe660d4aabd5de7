#include "app/pbreport/scaling/scaling_text.h"

#include <algorithm>

#include "app/common/format.h"
#include "app/pbreport/suite/characterise.h"
#include "app/pbreport/tables/text_cells.h"
#include "core/clock.h"
#include "core/statistics.h"

namespace pbmpi::app {
namespace {

using Cells = std::vector<std::string>;

std::string plural(int count, const std::string& noun) {
  return std::to_string(count) + " " + noun + (count == 1 ? "" : "s");
}

/// Milliseconds in each phase by number of ranks; leaves out phases in which no rank spent time.
std::vector<Cells> phase_cells(const ScalingCurve& curve) {
  std::vector<Cells> rows(1, Cells{"ms a frame, mean rank"});
  for (const ScalingPoint& point : curve.points)
    rows.front().push_back(plural(point.ranks, "rank") +
                           (point.decomposition == curve.decomposition ? "" : ", " + point.decomposition));
  for (const std::string_view phase : core::phase_names) {
    Cells row = {std::string(phase)};
    double most_s = 0;
    for (const ScalingPoint& point : curve.points) {
      const double seconds = phase_s(point, std::string(phase));
      most_s = std::max(most_s, seconds);
      row.push_back(format("%.4f", 1e3 * seconds));
    }
    if (most_s > 0) rows.push_back(std::move(row));
  }
  return rows;
}

}  // namespace

std::string name_of(ScalingKind kind) { return kind == ScalingKind::strong ? "strong" : "weak"; }

std::string title_of(const ScalingCurve& curve) {
  const ScalingPoint& base = curve.points[curve.base];
  const std::string worlds = curve.kind == ScalingKind::strong
                                 ? plural(base.worlds, "world")
                                 : format("%g worlds a rank", static_cast<double>(base.worlds) / base.ranks);
  return curve.first->scene + ", " + worlds + ", " + curve.first->stepper + " " + curve.first->precision +
         ": " + name_of(curve.kind) + " scaling, " + curve.decomposition + " over ranks";
}

std::string base_text(const ScalingCurve& curve) {
  const ScalingPoint& base = curve.points[curve.base];
  std::string text = format("Base: %s, %s, %.4g ms a frame of %s.", plural(base.ranks, "rank").c_str(),
                            base.decomposition == "worlds" ? "whole worlds" : "cut into spaces",
                            1e3 * base.median_of(&ScalingRun::frame_s),
                            plural(curve.first->steps_per_frame, "step").c_str());
  if (curve.figure6)
    text += format(
        " As in the paper's Figure 6, with %s: with a core for each island %.2f times one core, "
        "and for each space, too, %.2f.",
        curve.figure6->stepper.c_str(), curve.figure6->islands, curve.figure6->spaces);
  const PaperRow* paper = curve.kind == ScalingKind::strong ? paper_row(curve.first->scene) : nullptr;
  if (paper != nullptr)
    text += format(" The paper's Table 2 has %s for the islands of this scene.",
                   plural(paper->cores, "core").c_str());
  return text;
}

std::string doubts_text(const ScalingPoint& point) {
  std::string text;
  for (const std::string& doubt : point.doubts) text += (text.empty() ? "" : "; ") + doubt;
  return text;
}

double ideal_speed_up(const ScalingCurve& curve, const ScalingPoint& point) {
  return static_cast<double>(point.ranks) / curve.points[curve.base].ranks;
}

double phase_s(const ScalingPoint& point, const std::string& phase) {
  std::vector<double> seconds;
  for (const ScalingRun* run : point.runs) {
    const auto found = run->phase_s.find(phase);
    seconds.push_back(found == run->phase_s.end() ? 0 : found->second);
  }
  return core::quantile(seconds, 0.5);
}

double bound_of(const ScalingCurve& curve, const ScalingPoint& point) {
  const double ideal = ideal_speed_up(curve, point);
  const double island_bound = point.median_of(&ScalingRun::island_bound);
  return island_bound > 0 ? std::min(ideal, island_bound) : ideal;
}

std::string estimated_text(const Estimated& value) {
  return format("%.3f (%.3f to %.3f)", value.median, value.interval.low, value.interval.high);
}

std::vector<std::vector<std::string>> point_cells(const ScalingCurve& curve) {
  std::vector<Cells> rows = {{"ranks", "worlds", "runs", "frame [ms]", "speed-up", "bound", "efficiency",
                              "balance", "serialisation", "transfer", "computation", "root", "messages", "kB",
                              "within budget", "reportable"}};
  const auto percent = [](double share) { return format("%.1f %%", 100 * share); };
  for (const ScalingPoint& point : curve.points) {
    const bool is_base = &point == &curve.points[curve.base];
    rows.push_back({std::to_string(point.ranks) +
                        (point.decomposition == curve.decomposition ? "" : ", " + point.decomposition),
                    std::to_string(point.worlds), std::to_string(point.runs.size()),
                    format("%.4g", 1e3 * point.median_of(&ScalingRun::frame_s)),
                    is_base ? "1" : estimated_text(point.speed_up), format("%.2f", bound_of(curve, point)),
                    is_base ? "1" : estimated_text(point.efficiency),
                    percent(point.median_of(&PopEfficiencies::load_balance)),
                    percent(point.median_of(&PopEfficiencies::serialisation)),
                    percent(point.median_of(&PopEfficiencies::transfer)), percent(point.computation),
                    percent(point.median_of(&ScalingRun::root_share)),
                    format("%.1f", point.median_of(&ScalingRun::messages)),
                    format("%.1f", 1e-3 * point.median_of(&ScalingRun::bytes)),
                    percent(point.median_of(&ScalingRun::within_budget)),
                    point.doubts.empty() ? "yes" : "no: " + doubts_text(point)});
  }
  return rows;
}

std::string scaling_text(const std::vector<ScalingCurve>& curves, const std::vector<std::string>& left_out) {
  std::string text;
  for (const ScalingCurve& curve : curves) {
    text += (text.empty() ? "" : "\n") + title_of(curve) + "\n" + base_text(curve) + "\n" +
            aligned(point_cells(curve)) + aligned(phase_cells(curve));
  }
  for (const std::string& file : left_out)
    text += "left out: " + file + ": there is no run of the same work on other ranks\n";
  return text;
}

std::string scaling_markdown(const std::vector<ScalingCurve>& curves) {
  std::string text;
  for (const ScalingCurve& curve : curves) {
    text += (text.empty() ? "" : "\n") + ("**" + title_of(curve) + ".** ") + base_text(curve) + "\n\n" +
            markdown(point_cells(curve));
  }
  return text;
}

}  // namespace pbmpi::app
