#include "app/pbreport/ensemble/ensemble_bodies.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/error.h"

namespace pbmpi::app {
namespace {

using core::Vec3;

/// Positions of all samples in one recorded frame; for each body those of samples 0, 1, 2 ...
class Samples {
 public:
  Samples(const EnsembleRuns& ensemble, std::int64_t row)
      : num_bodies_(static_cast<std::size_t>(ensemble.num_bodies())) {
    for (const io::RunTables& run : ensemble.runs()) {
      const io::RunTable* found = run.find("bodies");
      core::require_input(found != nullptr, run.path() + ": it has no positions of bodies");
      io::RunTable table = *found;
      table.columns = {"/particles/bodies/position/value"};
      const auto values = std::get<std::vector<double>>(run.read(table, row, 1).front().values);
      positions_.insert(positions_.end(), values.begin(), values.end());
    }
  }
  std::size_t num() const { return positions_.size() / (3 * num_bodies_); }
  Vec3 at(std::size_t sample, std::size_t body) const {
    return Vec3(&positions_[3 * (sample * num_bodies_ + body)]);
  }

 private:
  std::size_t num_bodies_;
  std::vector<double> positions_;  ///< [runs][bodies][3]; worlds of a run follow each other
};

BodySpread spread_of_body(const Samples& samples, std::size_t body, const std::vector<double>& quantiles) {
  constexpr double unknown = std::numeric_limits<double>::quiet_NaN();
  Vec3 sum = Vec3::Zero();
  double count = 0;
  for (std::size_t i = 0; i < samples.num(); ++i) {
    if (!samples.at(i, body).allFinite()) continue;
    sum += samples.at(i, body);
    ++count;
  }
  BodySpread spread;
  spread.mean = count > 0 ? Vec3(sum / count) : Vec3(unknown, unknown, unknown);
  std::vector<double> distances;
  double squares = 0;
  for (std::size_t i = 0; i < samples.num(); ++i) {
    const Vec3 position = samples.at(i, body);
    distances.push_back(position.allFinite() ? (position - spread.mean).norm() : unknown);
    if (position.allFinite()) squares += distances.back() * distances.back();
  }
  spread.rms_m = count > 0 ? std::sqrt(squares / count) : unknown;
  spread.distance = spread_of(distances, quantiles);
  return spread;
}

PositionSpread join_bodies(std::size_t frame, const std::vector<BodySpread>& bodies,
                           const std::vector<double>& quantiles) {
  PositionSpread all;
  all.frame = frame;
  std::vector<double> rms;
  double squares = 0, count = 0;
  for (const BodySpread& body : bodies) {
    rms.push_back(body.rms_m);
    if (!std::isfinite(body.rms_m)) continue;
    const auto samples = static_cast<double>(body.distance.count);
    squares += samples * body.rms_m * body.rms_m;
    count += samples;
    const auto here = static_cast<std::int64_t>(rms.size()) - 1;
    if (all.widest < 0 || body.rms_m > bodies[static_cast<std::size_t>(all.widest)].rms_m) all.widest = here;
  }
  all.rms_m = count > 0 ? std::sqrt(squares / count) : std::numeric_limits<double>::quiet_NaN();
  all.of_bodies = spread_of(rms, quantiles);
  return all;
}

/// Sums of squares and number of samples of a body over the frames.
struct Sums {
  double squares = 0, count = 0;
};

void add(const BodySpread& body, Sums& sums, BodySummary& summary) {
  summary.nonfinite += body.distance.nonfinite;
  if (body.distance.count == 0) return;
  const auto samples = static_cast<double>(body.distance.count);
  sums.squares += samples * body.rms_m * body.rms_m;
  sums.count += samples;
  summary.max_m = std::max(summary.max_m, body.distance.max);
}

}  // namespace

EnsemblePositions spread_of_positions(const EnsembleRuns& ensemble, const std::vector<double>& quantiles,
                                      bool keep_bodies) {
  const auto num_bodies = static_cast<std::size_t>(ensemble.num_bodies());
  const std::int64_t every = ensemble.first().record_every();
  EnsemblePositions found;
  found.bodies.resize(num_bodies);
  std::vector<Sums> sums(num_bodies);
  for (std::int64_t row = 0; row < ensemble.num_recorded(); ++row) {
    const auto frame = static_cast<std::size_t>((row + 1) * every - 1);
    const Samples samples(ensemble, row);
    std::vector<BodySpread> bodies;
    for (std::size_t body = 0; body < num_bodies; ++body) {
      bodies.push_back(spread_of_body(samples, body, quantiles));
      if (ensemble.first().frames()[frame].is_measured) add(bodies.back(), sums[body], found.bodies[body]);
      found.bodies[body].last = bodies.back();
    }
    found.frames.push_back(join_bodies(frame, bodies, quantiles));
    if (keep_bodies) found.frames.back().bodies = std::move(bodies);
  }
  for (std::size_t body = 0; body < num_bodies; ++body)
    found.bodies[body].rms_m = sums[body].count > 0 ? std::sqrt(sums[body].squares / sums[body].count)
                                                    : std::numeric_limits<double>::quiet_NaN();
  return found;
}

}  // namespace pbmpi::app
