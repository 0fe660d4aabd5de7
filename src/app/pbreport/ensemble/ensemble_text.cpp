#include "app/pbreport/ensemble/ensemble_text.h"

#include <set>

#include "app/common/format.h"
#include "core/text.h"

namespace pbmpi::app {
namespace {

/// A line of the summary: a quantity in the last frame.
struct Line {
  std::string name, unit;
  const Spread* spread;
};

std::vector<Line> last_frame(const Ensemble& found) {
  std::vector<Line> lines;
  for (const QuantitySpread& quantity : found.quantities)
    lines.push_back({quantity.name, quantity.unit, &quantity.by_frame.back()});
  return lines;
}

std::size_t num_hashes(const EnsembleRuns& runs) {
  std::set<std::string> hashes;
  for (const io::RunTables& run : runs.runs()) hashes.insert(core::value_in(run.attributes(), "state_hash"));
  return hashes.size();
}

std::string position_line(const EnsembleRuns& runs, const PositionSpread& last) {
  if (last.widest < 0) return "positions: none is finite\n";
  const auto body = static_cast<std::size_t>(last.widest);
  return format(
      "positions: in frame %lld samples are %.4g m rms from their mean; a body %.4g m at most: %s\n",
      static_cast<long long>(runs.first().frames()[last.frame].frame), last.rms_m, last.of_bodies.max,
      runs.first().items().body_name[body].c_str());
}

std::string head(const EnsembleRuns& runs, const EnsembleOptions& options) {
  const io::FrameTime& last = runs.first().frames()[static_cast<std::size_t>(runs.num_frames() - 1)];
  std::string text = format("scene: %s\nsamples: %lld (%s)\nframes: %lld to %lld (%.6g s)\n",
                            core::value_in(runs.first().attributes(), "scene").c_str(),
                            static_cast<long long>(runs.num_samples()),
                            options.over == SampleOf::worlds ? "each world of each run" : "runs",
                            static_cast<long long>(runs.first().frames().front().frame),
                            static_cast<long long>(last.frame), last.time_s);
  text += format("state_hashes: %zu different in %zu runs\n", num_hashes(runs), runs.runs().size());
  for (const io::RunTables& run : runs.runs())
    text += format("run: %s, seed %s, solver_seed %s, %zu frames, hash %s\n", run.path().c_str(),
                   core::value_in(run.parameters(), "seed").c_str(),
                   core::value_in(run.parameters(), "solver_seed").c_str(), run.frames().size(),
                   core::value_in(run.attributes(), "state_hash").c_str());
  for (const std::string& one : runs.differences()) text += "differs: " + one + "\n";
  return text;
}

}  // namespace

std::string ensemble_text(const EnsembleRuns& runs, const Ensemble& found, const EnsembleOptions& options) {
  std::string text = head(runs, options);
  for (const Line& line : last_frame(found)) {
    text += format("%s: mean %.6g, stddev %.4g, min %.6g, ", line.name.c_str(), line.spread->mean,
                   line.spread->stddev, line.spread->min);
    for (std::size_t q = 0; q < options.quantiles.size(); ++q)
      text += format("%s %.6g, ", quantile_name(options.quantiles[q]).c_str(), line.spread->quantiles[q]);
    text += format("max %.6g%s%s", line.spread->max, line.unit.empty() ? "" : " ", line.unit.c_str());
    if (line.spread->nonfinite > 0)
      text += format("; %lld not finite", static_cast<long long>(line.spread->nonfinite));
    text += "\n";
  }
  return found.positions.frames.empty() ? text : text + position_line(runs, found.positions.frames.back());
}

std::string ensemble_markdown(const EnsembleRuns& runs, const Ensemble& found,
                              const EnsembleOptions& options) {
  std::string text = "| quantity | unit | mean | stddev | min |", rule = "|---|---|--:|--:|--:|";
  for (const double q : options.quantiles) {
    text += " " + quantile_name(q) + " |";
    rule += "--:|";
  }
  text += " max |\n" + rule + "--:|\n";
  for (const Line& line : last_frame(found)) {
    text += format("| %s | %s | %.6g | %.4g | %.6g |", line.name.c_str(), line.unit.c_str(),
                   line.spread->mean, line.spread->stddev, line.spread->min);
    for (const double value : line.spread->quantiles) text += format(" %.6g |", value);
    text += format(" %.6g |\n", line.spread->max);
  }
  return text + "\n" +
         (found.positions.frames.empty() ? "" : position_line(runs, found.positions.frames.back()));
}

}  // namespace pbmpi::app
