#include "app/pbmpi/world_results.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <span>
#include <utility>

#include "core/hash.h"

namespace pbmpi::app {
namespace {

constexpr std::int64_t never = std::numeric_limits<std::int64_t>::max();

/// A NaN, which is larger than nothing, is passed over.
void raise(double& largest, double value) {
  if (std::isfinite(value) && value > largest) largest = value;
}

template <class Values>
Values joined(const mpi::Communicator& comm, Values values, mpi::Reduce how) {
  comm.allreduce(std::span(values), how);
  return values;
}

}  // namespace

WorldResults::WorldResults(int num_worlds, Costs costs)
    : costs_of_frame_(std::move(costs)),
      contacts_(static_cast<std::size_t>(num_worlds)),
      arrivals_(contacts_.size()),
      seen_until_(contacts_.size()),
      nonfinite_step_(contacts_.size(), never),
      energy_first_j_(contacts_.size()),
      joint_gap_max_m_(contacts_.size()),
      penetration_max_m_(contacts_.size()),
      row_visits_(contacts_.size()),
      cost_s_(contacts_.size()) {}

void WorldResults::frame_done(const stepping::FrameRecord& frame) {
  for (const stepping::LocalWorld& world : frame.worlds) {
    add(world, frame);
    std::int64_t& seen_until = seen_until_[static_cast<std::size_t>(world.id)];
    if (seen_until != num_frames_) ++arrivals_[static_cast<std::size_t>(world.id)];
    seen_until = num_frames_ + 1;
  }
  for (const mpi::WorldCost& cost : costs_of_frame_())
    cost_s_[static_cast<std::size_t>(cost.world)] += cost.seconds;
  ++num_frames_;
}

void WorldResults::add(const stepping::LocalWorld& world, const stepping::FrameRecord& frame) {
  const auto i = static_cast<std::size_t>(world.id);
  const stepping::Observables& seen = *world.observables;
  if (num_frames_ == 0) energy_first_j_[i] = seen.energy_j;
  if (seen.nonfinite > 0) nonfinite_step_[i] = std::min(nonfinite_step_[i], frame.step);
  contacts_[i] += seen.contacts;
  row_visits_[i] += seen.row_visits;
  raise(joint_gap_max_m_[i], seen.joint_gap_m);
  raise(penetration_max_m_[i], seen.max_penetration_m);
}

std::vector<io::WorldResult> WorldResults::join(const mpi::Communicator& comm,
                                                const std::vector<stepping::LocalWorld>& last) const {
  Numbers energy_last_j(contacts_.size());
  Counts frozen_in(contacts_.size(), -1);
  std::vector<std::uint64_t> hash(contacts_.size());
  for (const stepping::LocalWorld& world : last) {
    const auto i = static_cast<std::size_t>(world.id);
    energy_last_j[i] = world.observables->energy_j;
    frozen_in[i] = world.state->guard.frozen_in;
    hash[i] = model::hash(*world.state);
  }
  // Of first and last values all ranks but one have 0; -0 + 0 is 0.
  energy_last_j = joined(comm, energy_last_j, mpi::Reduce::sum);
  frozen_in = joined(comm, frozen_in, mpi::Reduce::max);
  hash = joined(comm, hash, mpi::Reduce::max);
  const Numbers energy_first_j = joined(comm, energy_first_j_, mpi::Reduce::sum);
  const Numbers row_visits = joined(comm, row_visits_, mpi::Reduce::sum);
  const Numbers cost_s = joined(comm, cost_s_, mpi::Reduce::sum);
  const Numbers joint_gap_max_m = joined(comm, joint_gap_max_m_, mpi::Reduce::max);
  const Numbers penetration_max_m = joined(comm, penetration_max_m_, mpi::Reduce::max);
  const Counts contacts = joined(comm, contacts_, mpi::Reduce::sum);
  const Counts moves = joined(comm, arrivals_, mpi::Reduce::sum);
  Counts sooner = nonfinite_step_;  // the least is the largest of what is left to the end
  for (std::int64_t& step : sooner) step = never - step;
  sooner = joined(comm, sooner, mpi::Reduce::max);

  std::vector<io::WorldResult> results(contacts_.size());
  for (std::size_t i = 0; i < results.size(); ++i) {
    io::WorldResult& result = results[i];
    result.nonfinite_step = sooner[i] == 0 ? -1 : never - sooner[i];
    result.frozen_in = frozen_in[i];
    result.survived = result.nonfinite_step < 0 && result.frozen_in < 0 ? 1 : 0;
    result.frames = num_frames_;
    result.energy_first_j = energy_first_j[i];
    result.energy_last_j = energy_last_j[i];
    result.joint_gap_max_m = joint_gap_max_m[i];
    result.penetration_max_m = penetration_max_m[i];
    result.contacts_mean =
        static_cast<double>(contacts[i]) / static_cast<double>(std::max<std::int64_t>(num_frames_, 1));
    result.row_visits = row_visits[i];
    result.cost_s = cost_s[i];
    result.moves = moves[i];
    result.state_hash = core::to_hex(hash[i]);
  }
  return results;
}

}  // namespace pbmpi::app
