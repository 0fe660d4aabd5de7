#include "app/summary/live_summary.h"

#include <algorithm>

#include "core/hash.h"
#include "core/system/peak_memory.h"
#include "mpi/comm/tree_gather.h"

namespace pbmpi::app {

void LiveSummary::frame_done(const stepping::FrameRecord& frame) {
  observed_.measured.push_back(frame.measured);
  energies_.clear();
  for (const stepping::LocalWorld& world : frame.worlds)
    energies_.push_back({world.id, world.observables->energy_j});
  std::vector<double> numbers(frame.worlds.size());
  for (std::size_t i = 0; i < stepping::world_observables.size(); ++i) {
    const stepping::WorldColumn& column = stepping::world_observables[i];
    if (column.is_vector()) continue;
    std::transform(frame.worlds.begin(), frame.worlds.end(), numbers.begin(),
                   [&](const auto& world) { return stepping::number_of(*world.observables, column); });
    observed_.joined[i].push_back(stepping::join(column.join, numbers));
  }
}

namespace {

ObservedFrames join_ranks(const mpi::Communicator& comm, ObservedFrames observed) {
  for (std::size_t i = 0; i < observed.joined.size(); ++i) {
    const bool is_sum = stepping::world_observables[i].join == stepping::Join::sum;
    comm.allreduce(std::span<double>(observed.joined[i]), is_sum ? mpi::Reduce::sum : mpi::Reduce::max);
  }
  return observed;
}

/// Times on root; elsewhere without the phases, since only root has room for those of all ranks.
MeasuredFrames gather_times(const mpi::Communicator& comm, const mpi::WorldRunResult& result) {
  MeasuredFrames frames;
  std::vector<double> own;
  double processor_s = 0;
  for (const mpi::FrameTimes& times : result.times) {
    if (!times.measured) continue;
    frames.wall_s.push_back(times.wall_s);
    frames.messages.push_back(static_cast<double>(times.traffic.messages));
    frames.bytes.push_back(static_cast<double>(times.traffic.bytes));
    processor_s += times.processor_s;
    own.insert(own.end(), times.phases.seconds.begin(), times.phases.seconds.end());
  }
  comm.allreduce(std::span<double>(frames.messages), mpi::Reduce::sum);
  comm.allreduce(std::span<double>(frames.bytes), mpi::Reduce::sum);
  frames.processor_s = comm.allgather(processor_s);
  const std::vector<double> all = mpi::gather_rows(comm, std::span<const double>(own));
  if (!comm.is_root()) return frames;
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

MemorySummary memory_of_ranks(const mpi::Communicator& comm) {
  const std::vector<std::int64_t> peaks = comm.allgather(core::peak_memory_bytes());
  const auto [least, most] = std::minmax_element(peaks.begin(), peaks.end());
  return {*least, *most, static_cast<int>(least - peaks.begin()), static_cast<int>(most - peaks.begin())};
}

}  // namespace

double LiveSummary::total_energy(const mpi::Communicator& comm) const {
  std::vector<WorldEnergy> all = mpi::gather_rows(comm, std::span<const WorldEnergy>(energies_));
  std::sort(all.begin(), all.end(), [](const auto& a, const auto& b) { return a.world < b.world; });
  std::vector<double> energies(all.size());
  std::transform(all.begin(), all.end(), energies.begin(), [](const auto& one) { return one.energy_j; });
  return stepping::join(stepping::Join::sum, energies);
}

void LiveSummary::finish(const mpi::Communicator& comm, const mpi::WorldRunResult& result,
                         RunSummary& summary) const {
  MeasuredFrames frames = gather_times(comm, result);
  const ObservedFrames observed = join_ranks(comm, observed_);
  take_counts(observed, frames);
  take_invariants(observed, summary);
  summary.energy_j = total_energy(comm);
  summary.complete = !result.stopped && result.failure.empty();
  summary.state_hash = core::to_hex(result.state_hash);
  summary.joints_broken = joints_broken_;
  summary.guards = guards_;
  summary.rebalances = result.num_rebalances;
  summary.worlds_moved = result.worlds_moved;
  compute_performance(frames, summary);
  summary.memory = memory_of_ranks(comm);
}

}  // namespace pbmpi::app
