#include "app/pbreport/ensemble/ensemble_runs.h"

#include <algorithm>
#include <cmath>

#include "core/error.h"
#include "core/text.h"
#include "io/extract/run_settings.h"

namespace pbmpi::app {
namespace {

using core::require_input;
using io::Matters;
using io::RunTables;

std::string seeds_of(const RunTables& run) {
  const std::string range = core::value_in(run.parameters(), "world_range");
  return "seed " + core::value_in(run.parameters(), "seed") + ", solver_seed " +
         core::value_in(run.parameters(), "solver_seed") + (range.empty() ? "" : ", worlds " + range);
}

/// Names of the bodies of the first world.
std::vector<std::string> bodies_of_a_world(const RunTables& run) {
  const auto& names = run.items().body_name;
  return {names.begin(), names.begin() + std::ssize(names) / run.items().num_worlds};
}

/// Parameters in which runs differ, and which the user has not allowed.
std::vector<io::ParameterDifference> refused(const RunTables& a, const RunTables& b,
                                             const std::vector<std::string>& allowed) {
  auto apart = io::differences(a.parameters(), b.parameters(), Matters::results);
  std::erase_if(apart, [&](const io::ParameterDifference& one) {
    return std::ranges::find(allowed, one.name) != allowed.end();
  });
  return apart;
}

void require_same_times(const RunTables& a, const RunTables& b) {
  const std::size_t frames = std::min(a.frames().size(), b.frames().size());
  require_input(frames > 0, a.path() + " and " + b.path() + ": one of them has no frame");
  for (std::size_t i = 0; i < frames; ++i) {
    const io::FrameTime &x = a.frames()[i], &y = b.frames()[i];
    // Times are step x dt, so another dt rounds differently.
    require_input(
        x.frame == y.frame && std::abs(x.time_s - y.time_s) <= 1e-9 && x.is_measured == y.is_measured,
        a.path() + " and " + b.path() + ": frame " + std::to_string(x.frame) +
            " is not at the same time in both, or is warm-up in one; give all the same frame length, "
            "warm-up and start");
  }
}

}  // namespace

EnsembleRuns::EnsembleRuns(const EnsembleOptions& options) : over_(options.over) {
  for (const std::string& path : options.files) runs_.emplace_back(path);
  num_frames_ = std::ssize(first().frames());
  require_input(num_frames_ > 0, first().path() + ": it has no frame");
  for (std::size_t i = 1; i < runs_.size(); ++i) {
    require_comparable(runs_[i], options);
    require_new_sample(i);
    num_frames_ = std::min<std::int64_t>(num_frames_, std::ssize(runs_[i].frames()));
  }
  if (over_ == SampleOf::worlds) {
    for (const RunTables& run : runs_) require_equal_worlds(run);
  }
}

void EnsembleRuns::require_comparable(const RunTables& run, const EnsembleOptions& options) {
  const std::string both = first().path() + " and " + run.path();
  const auto apart = refused(first(), run, options.allowed);
  std::string names;
  for (const io::ParameterDifference& one : apart) names += " " + one.name;
  require_input(apart.empty(),
                both + " are not of one ensemble: " +
                    (apart.empty() ? "" : io::text_of(apart.front(), first().path(), run.path())) +
                    "; leave one out, or allow what differs (--allow" + names + ")");
  // Worlds are compared one by one, so runs may have different numbers of them: parts of an ensemble.
  const bool same_bodies = over_ == SampleOf::worlds
                               ? bodies_of_a_world(first()) == bodies_of_a_world(run)
                               : first().items().body_name == run.items().body_name &&
                                     first().items().body_world == run.items().body_world;
  require_input(same_bodies,
                both + " do not have the same bodies; compare runs of one scene with as many worlds");
  require_input(first().record_every() == run.record_every(),
                both + ": one has recorded every " + std::to_string(first().record_every()) +
                    " frames, the other every " + std::to_string(run.record_every()) +
                    "; give all the same --record-every");
  require_same_times(first(), run);
  for (const Matters matters : {Matters::results, Matters::estimate, Matters::nothing}) {
    for (const io::ParameterDifference& one :
         io::differences(first().parameters(), run.parameters(), matters)) {
      if (!one.name.starts_with("env_")) differences_.push_back(io::text_of(one, first().path(), run.path()));
    }
  }
}

void EnsembleRuns::require_new_sample(std::size_t index) const {
  const RunTables& run = runs_[index];
  for (std::size_t i = 0; i < index; ++i) {
    const bool other_settings =
        !io::differences(runs_[i].parameters(), run.parameters(), Matters::results).empty();
    require_input(other_settings || seeds_of(runs_[i]) != seeds_of(run),
                  runs_[i].path() + " and " + run.path() + " are the same sample (" + seeds_of(run) +
                      "), which would count twice; leave one out");
  }
}

void EnsembleRuns::require_equal_worlds(const RunTables& run) {
  const io::RunItems& items = run.items();
  const auto num = static_cast<std::size_t>(items.num_worlds);
  const std::size_t count = items.body_name.size() / num;
  bool equal = count * num == items.body_name.size();
  for (std::size_t i = 0; equal && i < items.body_name.size(); ++i)
    equal = items.body_name[i] == items.body_name[i % count];
  require_input(equal, run.path() + ": its worlds do not have the same bodies; leave out --over worlds");
}

std::int64_t EnsembleRuns::num_samples() const {
  std::int64_t samples = 0;
  for (const RunTables& run : runs_) samples += over_ == SampleOf::runs ? 1 : run.items().num_worlds;
  return samples;
}

std::int64_t EnsembleRuns::num_bodies() const {
  const std::int64_t all = std::ssize(first().items().body_name);
  return over_ == SampleOf::runs ? all : all / first().items().num_worlds;
}

}  // namespace pbmpi::app
