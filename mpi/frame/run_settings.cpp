#include "mpi/frame/run_settings.h"

#include <array>
#include <cmath>
#include <span>
#include <string>

#include "core/error.h"
#include "core/hash.h"
#include "mpi/comm/agreement.h"

namespace pbmpi::mpi {
namespace {

/// Throws core::InputError unless a driver of `num_ranks` ranks can run these settings.
void require_valid(const WorldRunSettings& settings, int num_parts, int num_ranks) {
  core::require_input(settings.num_worlds >= 1, "worlds: at least 1 is needed");
  core::require_input(settings.first_world >= 0, "first world: its number is negative");
  core::require_input(settings.warmup >= 0, "warm-up: the number of frames is negative");
  core::require_input(settings.frames >= 1, "frames: at least 1 measured frame is needed");
  core::require_input(settings.first_frame >= 0, "first frame: the number of frames done is negative");
  core::require_input(settings.first_frame < settings.warmup + settings.frames,
                      "frames: " + std::to_string(settings.first_frame) + " are done and none is left");
  core::require_input(settings.steps_per_frame >= 1, "steps per frame: at least 1 is needed");
  core::require_input(std::isfinite(settings.dt_s) && settings.dt_s > 0,
                      "dt: a time step is finite and above 0 s");
  core::require_input(settings.rebalance_threshold >= 1, "rebalance threshold: max/avg is never below 1");
  core::require_input(settings.placement.empty() || std::ssize(settings.placement) == num_parts,
                      "placement: one rank a world (or space) is needed");
  for (const int rank : settings.placement) {
    core::require_input(rank >= 0 && rank < num_ranks, "placement: there is no rank " + std::to_string(rank));
  }
}

std::uint64_t hash_of(const WorldRunSettings& settings) {
  core::Hash64 hash;
  for (const int number : {settings.num_worlds, settings.first_world, settings.warmup, settings.frames,
                           settings.steps_per_frame, settings.stop_at_blowup ? 1 : 0}) {
    hash.add(static_cast<std::uint64_t>(number));
  }
  for (const double number : {settings.dt_s, settings.budget_s, settings.rebalance_threshold})
    hash.add(&number, 1);
  hash.add(static_cast<std::uint64_t>(settings.first_frame));
  for (const int rank : settings.placement) hash.add(static_cast<std::uint64_t>(rank));
  return hash.value();
}

}  // namespace

WorldRunSettings checked_settings(const Communicator& comm, WorldRunSettings settings, int num_parts) {
  agree_on_errors(comm, [&] { require_valid(settings, num_parts, comm.size()); });
  const std::uint64_t mine = hash_of(settings);
  std::array<std::uint64_t, 2> extremes = {mine, ~mine};
  comm.allreduce(extremes, Reduce::max);
  core::require_invariant(extremes[0] == ~extremes[1], "WorldRunSettings are the same on every rank");
  return settings;
}

}  // namespace pbmpi::mpi
