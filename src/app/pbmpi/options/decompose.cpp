/// How the work of a run is cut over the ranks, and why some work cannot be cut.
#include <optional>
#include <string>

#include "app/pbmpi/options/options.h"
#include "core/error.h"
#include "stepping/names.h"

namespace pbmpi::app {

using core::require_input;

namespace {

/// Why this run's worlds stay whole, and what to do about it; nothing if one may be cut.
std::optional<std::string> why_whole(const RunSpec& spec) {
  if (!traits_of(spec.stepper.kind).cuts_spaces) {
    return "--decompose spaces needs --stepper sor (the solvers of engines give no access to single islands, "
           "and quick draws from one random seed for the whole world); add --stepper sor, or use --decompose "
           "worlds";
  }
  if (spec.stepper.residuals)
    return "--record residuals: no rank of a world that is cut has all its rows; use --decompose worlds";
  if (spec.estimate && !traits_of(spec.estimate->kind).cuts_spaces)
    return "--feec=" + std::string(name_of(spec.estimate->kind)) +
           ": a world that is cut is estimated by sor; use --decompose worlds";
  return std::nullopt;
}

/// Threads step separate worlds, so a world that is cut has one thread per rank.
void require_one_thread(int num_threads) {
  require_input(num_threads == 1,
                "--threads " + std::to_string(num_threads) +
                    ": a rank steps its part of a world that is cut into spaces with one thread; start more "
                    "ranks and leave --threads out, or use --decompose worlds");
}

/// Ranks per world: as asked, or all for one world, or as predicted.
mpi::RankGroups groups_of(const RunSpec& spec, std::span<const double> space_costs, int num_ranks) {
  int ranks_per_world = num_ranks;
  if (spec.num_worlds > 1)
    ranks_per_world = mpi::choose_ranks_per_world(space_costs, spec.num_worlds, num_ranks);
  return mpi::group_ranks(space_costs, spec.num_worlds, num_ranks,
                          spec.ranks_per_world.value_or(ranks_per_world));
}

/// Is it better to cut than to leave ranks without a world? Whole worlds keep the solver's lanes full, so
/// they are not cut where each rank has one.
bool cuts_by_itself(const RunSpec& spec, std::span<const double> space_costs, int num_ranks) {
  if (space_costs.size() < 2 || num_ranks < 2) return false;
  if (spec.num_worlds == 1) return true;
  return num_ranks > spec.num_worlds && spec.stepper.threads == 1 &&
         mpi::choose_ranks_per_world(space_costs, spec.num_worlds, num_ranks) > 1;
}

}  // namespace

Cut decompose(const RunSpec& spec, std::span<const double> space_costs, int num_ranks) {
  const std::optional<std::string> reason = why_whole(spec);
  const bool is_asked = spec.decomposition == Decomposition::spaces || spec.ranks_per_world;
  require_input(
      spec.decomposition != Decomposition::worlds || !spec.ranks_per_world,
      "--ranks-per-world " + std::to_string(spec.ranks_per_world.value_or(0)) +
          ": so many ranks cut a world, and --decompose worlds leaves all whole; leave it out, or give "
          "--decompose spaces");
  require_input(!is_asked || !reason, reason.value_or(""));
  const bool cuts = is_asked || (spec.decomposition == Decomposition::automatic && !reason &&
                                 cuts_by_itself(spec, space_costs, num_ranks));
  if (!cuts) return {};
  require_one_thread(spec.stepper.threads);
  return {Decomposition::spaces, groups_of(spec, space_costs, num_ranks)};
}

}  // namespace pbmpi::app
