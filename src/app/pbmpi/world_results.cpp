#include "app/pbmpi/world_results.h"

#include <algorithm>
#include <cmath>
#include <span>

#include "core/hash.h"
#include "mpi/comm/tree_gather.h"

namespace pbmpi::app {
namespace {

/// Ignores NaN and infinity.
void raise(double& largest, double value) {
  if (std::isfinite(value) && value > largest) largest = value;
}

}  // namespace

void WorldResults::frame_done(const stepping::FrameRecord& frame) {
  for (const stepping::LocalWorld& world : frame.worlds) add(world, frame);
  for (const mpi::WorldCost& cost : costs_of_frame_()) seen_[cost.world].cost_s += cost.seconds;
  ++num_frames_;
}

void WorldResults::add(const stepping::LocalWorld& world, const stepping::FrameRecord& frame) {
  Seen& seen = seen_[world.id];
  const stepping::Observables& now = *world.observables;
  if (num_frames_ == 0) seen.energy_first_j = now.energy_j;
  if (now.nonfinite > 0) seen.nonfinite_step = std::min(seen.nonfinite_step, frame.step);
  seen.contacts += now.contacts;
  seen.row_visits += now.row_visits;
  raise(seen.joint_gap_max_m, now.joint_gap_m);
  raise(seen.penetration_max_m, now.max_penetration_m);
  if (seen.seen_until != num_frames_) ++seen.arrivals;
  seen.seen_until = num_frames_ + 1;
}

/// First and last values are 0 on all ranks except one; -0 + 0 is 0.
void WorldResults::join(const Seen& part, Seen& whole) {
  whole.contacts += part.contacts;
  whole.arrivals += part.arrivals;
  whole.nonfinite_step = std::min(whole.nonfinite_step, part.nonfinite_step);
  whole.energy_first_j += part.energy_first_j;
  whole.joint_gap_max_m = std::max(whole.joint_gap_max_m, part.joint_gap_max_m);
  whole.penetration_max_m = std::max(whole.penetration_max_m, part.penetration_max_m);
  whole.row_visits += part.row_visits;
  whole.cost_s += part.cost_s;
  whole.frozen_in = std::max(whole.frozen_in, part.frozen_in);
  whole.energy_last_j += part.energy_last_j;
  whole.hash = std::max(whole.hash, part.hash);
}

io::WorldResult WorldResults::result_of(const Seen& seen) const {
  io::WorldResult result;
  result.nonfinite_step = seen.nonfinite_step == never ? -1 : seen.nonfinite_step;
  result.frozen_in = seen.frozen_in;
  result.survived = result.nonfinite_step < 0 && result.frozen_in < 0 ? 1 : 0;
  result.frames = num_frames_;
  result.energy_first_j = seen.energy_first_j;
  result.energy_last_j = seen.energy_last_j;
  result.joint_gap_max_m = seen.joint_gap_max_m;
  result.penetration_max_m = seen.penetration_max_m;
  result.contacts_mean =
      static_cast<double>(seen.contacts) / static_cast<double>(std::max<std::int64_t>(num_frames_, 1));
  result.row_visits = seen.row_visits;
  result.cost_s = seen.cost_s;
  result.moves = seen.arrivals;
  result.state_hash = core::to_hex(seen.hash);
  return result;
}

std::vector<io::WorldResult> WorldResults::join(const mpi::Communicator& comm,
                                                const std::vector<stepping::LocalWorld>& last) const {
  std::map<int, Seen> mine = seen_;
  for (const stepping::LocalWorld& world : last) {
    Seen& seen = mine[world.id];
    seen.energy_last_j = world.observables->energy_j;
    seen.frozen_in = world.state->guard.frozen_in;
    seen.hash = model::hash(*world.state);
  }
  std::vector<Seen> own;
  own.reserve(mine.size());
  for (auto& [world, seen] : mine) {
    seen.world = world;
    own.push_back(seen);
  }
  const std::vector<Seen> parts = mpi::gather_rows(comm, std::span<const Seen>(own));
  if (!comm.is_root()) return {};
  std::vector<Seen> wholes(static_cast<std::size_t>(num_worlds_));
  for (const Seen& part : parts) join(part, wholes[static_cast<std::size_t>(part.world)]);
  std::vector<io::WorldResult> results;
  results.reserve(wholes.size());
  for (const Seen& seen : wholes) results.push_back(result_of(seen));
  return results;
}

}  // namespace pbmpi::app
