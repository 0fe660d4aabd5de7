#include "app/pbmpi/live_summary.h"

#include <algorithm>

#include "core/hash.h"

namespace pbmpi::app {

void LiveSummary::frame_done(const stepping::FrameRecord& frame) {
  double islands = 0, contacts = 0, rows = 0, largest = 0;
  energy_j_ = 0;
  nonfinite_ = 0;
  for (const stepping::LocalWorld& world : frame.worlds) {
    const stepping::Observables& seen = *world.observables;
    islands += seen.islands;
    contacts += seen.contacts;
    rows += seen.rows;
    largest = std::max(largest, static_cast<double>(seen.max_island_rows));
    energy_j_ += seen.energy_j;
    nonfinite_ += seen.nonfinite;
    if (frame.measured) {
      max_joint_gap_m_ = std::max(max_joint_gap_m_, seen.joint_gap_m);
      max_penetration_m_ = std::max(max_penetration_m_, seen.max_penetration_m);
    }
  }
  if (!frame.measured) return;
  islands_.push_back(islands);
  contacts_.push_back(contacts);
  rows_.push_back(rows);
  max_island_rows_.push_back(largest);
}

namespace {

std::vector<double> reduced(const mpi::Communicator& comm, std::vector<double> values, mpi::Reduce op) {
  comm.allreduce(std::span<double>(values), op);
  return values;
}

MeasuredFrames gather_times(const mpi::Communicator& comm, const mpi::WorldRunResult& result) {
  MeasuredFrames frames;
  std::vector<double> own;
  for (const mpi::FrameTimes& times : result.times) {
    if (!times.measured) continue;
    frames.wall_s.push_back(times.wall_s);
    frames.messages.push_back(static_cast<double>(times.traffic.messages));
    frames.bytes.push_back(static_cast<double>(times.traffic.bytes));
    own.insert(own.end(), times.phases.seconds.begin(), times.phases.seconds.end());
  }
  frames.messages = reduced(comm, frames.messages, mpi::Reduce::sum);
  frames.bytes = reduced(comm, frames.bytes, mpi::Reduce::sum);
  const std::vector<double> all = comm.allgatherv(std::span<const double>(own));
  frames.phases.resize(static_cast<std::size_t>(comm.size()));
  auto next = all.begin();
  for (auto& rank : frames.phases) {
    rank.resize(frames.wall_s.size());
    for (auto& frame : rank) {
      std::copy_n(next, frame.size(), frame.begin());
      next += static_cast<std::ptrdiff_t>(frame.size());
    }
  }
  return frames;
}

}  // namespace

void LiveSummary::finish(const mpi::Communicator& comm, const mpi::WorldRunResult& result,
                         RunSummary& summary) const {
  MeasuredFrames frames = gather_times(comm, result);
  frames.islands = reduced(comm, islands_, mpi::Reduce::sum);
  frames.contacts = reduced(comm, contacts_, mpi::Reduce::sum);
  frames.rows = reduced(comm, rows_, mpi::Reduce::sum);
  frames.max_island_rows = reduced(comm, max_island_rows_, mpi::Reduce::max);
  const std::vector<double> last = reduced(comm, {energy_j_, nonfinite_}, mpi::Reduce::sum);
  const std::vector<double> largest = reduced(comm, {max_joint_gap_m_, max_penetration_m_}, mpi::Reduce::max);
  summary.energy_j = last[0];
  summary.nonfinite_bodies = static_cast<std::int64_t>(last[1]);
  summary.max_joint_gap_m = largest[0];
  summary.max_penetration_m = largest[1];
  summary.complete = !result.stopped && result.failure.empty();
  summary.state_hash = core::to_hex(result.state_hash);
  summary.joints_broken = joints_broken_;
  summary.rebalances = result.num_rebalances;
  summary.worlds_moved = result.worlds_moved;
  compute_performance(frames, summary);
}

}  // namespace pbmpi::app
