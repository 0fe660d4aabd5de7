#include "mpi/spaces/space_driver.h"

#include <algorithm>
#include <array>
#include <utility>

#include <fmt/core.h>

#include "core/error.h"
#include "mpi/frame/state_transfer.h"
#include "mpi/frame/whole_state.h"
#include "mpi/spaces/plan/initial_owners.h"

namespace pbmpi::mpi {
namespace {

std::string describe(const Reassignment& plan) {
  return fmt::format("{} space{} moved: busiest rank {:.3f} -> {:.3f} ms a frame", plan.moves.size(),
                     plan.moves.size() == 1 ? "" : "s", 1e3 * plan.makespan_before_s,
                     1e3 * plan.makespan_after_s);
}

std::string describe_many(std::int64_t num_moves, std::int64_t num_worlds) {
  return fmt::format("{} space{} moved, of {} world{}", num_moves, num_moves == 1 ? "" : "s", num_worlds,
                     num_worlds == 1 ? "" : "s");
}

/// The number of parts that a placement places; an idle rank takes the placement as it is.
int num_parts(std::span<stepping::SpaceStepper* const> steppers, const WorldRunSettings& settings) {
  return steppers.empty() ? static_cast<int>(std::ssize(settings.placement))
                          : steppers.front()->map().num_spaces();
}

}  // namespace

SpaceDriver::SpaceDriver(const Communicator& comm, stepping::SpaceStepper& stepper,
                         const WorldRunSettings& settings, std::span<const model::State> states)
    : SpaceDriver(comm, std::array{&stepper}, RankGroups::of_all(comm.size()), settings, states) {}

SpaceDriver::SpaceDriver(const Communicator& comm, std::span<stepping::SpaceStepper* const> steppers,
                         const RankGroups& groups, const WorldRunSettings& settings,
                         std::span<const model::State> states)
    : FrameDriver(comm, settings, num_parts(steppers, settings)),
      groups_(groups),
      roots_(groups.roots()),
      group_(this->comm().split(groups.group_of_rank(comm.rank()))),
      ids_(groups.worlds_of(groups.group_of_rank(comm.rank()))) {
  core::require_invariant(settings.num_worlds == groups.num_worlds() && steppers.size() == ids_.size(),
                          "SpaceDriver: a stepper for each world of the group");
  build(steppers);
  const std::map<int, model::State> at_start = starts(states);
  for (std::size_t i = 0; i < worlds_.size(); ++i)
    worlds_[i]->begin(at_start.at(ids_[i]), this->settings().first_step());
  agree(this->comm(), errors());
  count_bodies();
  gather_ = std::make_unique<PoseGather>(this->comm(), table_, roots_);
}

void SpaceDriver::build(std::span<stepping::SpaceStepper* const> steppers) {
  agree_on_errors(comm(), [&] {
    for (const int rank : ids_.empty() ? std::vector<int>() : settings().placement) {
      core::require_input(rank < group_.size(), "placement: there is no rank " + std::to_string(rank) +
                                                    " in a group of " + std::to_string(group_.size()));
    }
    for (stepping::SpaceStepper* stepper : steppers) {
      std::vector<int> owners = settings().placement;
      if (owners.empty()) owners = initial_owners(stepper->model(), stepper->map(), group_.size());
      worlds_.push_back(
          std::make_unique<CutWorld>(group_, *stepper, errors(), settings(), std::move(owners)));
    }
  });
}

/// Collective. The states from which the worlds of this rank's group start.
std::map<int, model::State> SpaceDriver::starts(std::span<const model::State> states) const {
  std::map<int, model::State> own;
  if (settings().first_step() == 0) {
    for (const int world : ids_) own[world] = model::initial_state(at(world).model());
    return own;
  }
  own = scatter_states(comm(), roots_, states);
  agree_on_errors(comm(), [&] {
    for (const auto& [world, state] : own) require_fit(world, state, at(world).model());
  });
  for (const int world : ids_) own[world] = share_state(group_, own[world]);
  return own;
}

void SpaceDriver::count_bodies() {
  std::vector<std::int64_t> num_bodies(roots_.size(), 0);
  for (const int world : ids_) num_bodies[world] = at(world).model().num_bodies();
  comm().allreduce(num_bodies, Reduce::max);
  for (const std::int64_t count : num_bodies) table_.body_offset.push_back(table_.body_offset.back() + count);
}

void SpaceDriver::watch(const stability::GuardSettings& settings) {
  for (std::size_t i = 0; i < worlds_.size(); ++i)
    worlds_[i]->watch(this->settings().first_world + ids_[i], settings);
}

std::vector<stepping::LocalWorld> SpaceDriver::local_worlds() const {
  std::vector<stepping::LocalWorld> worlds;
  if (!group_.is_root()) return worlds;
  for (std::size_t i = 0; i < worlds_.size(); ++i) {
    const CutWorld& world = *worlds_[i];
    worlds.push_back(
        {ids_[i], &world.model(), &world.state(), &world.observables(), nullptr, world.contacts()});
  }
  return worlds;
}

std::vector<WorldCost> SpaceDriver::costs() const {
  std::vector<WorldCost> costs;
  for (std::size_t i = 0; i < worlds_.size(); ++i) costs.push_back({ids_[i], worlds_[i]->cost_s()});
  return costs;
}

std::vector<int> SpaceDriver::idle_ranks() const {
  const auto has_bodies = [&](const auto& world) {
    return !world->ownership().bodies[group_.rank()].empty();
  };
  const std::vector<char> is_idle =
      comm().allgather(static_cast<char>(std::ranges::none_of(worlds_, has_bodies)));
  std::vector<int> idle;
  for (int rank = 0; rank < comm().size(); ++rank) {
    if (is_idle[rank] != 0) idle.push_back(rank);
  }
  return idle;
}

void SpaceDriver::estimate_with(std::span<stepping::SpaceStepper* const> steppers) {
  core::require_invariant(steppers.size() == worlds_.size(), "SpaceDriver: a stepper for each world");
  estimating_ = group_.dup();
  gather_estimates(table_, roots_);
  for (std::size_t i = 0; i < worlds_.size(); ++i) {
    CutWorld& world = *worlds_[i];
    world.estimate_with(estimating_, *steppers[i]);
    if (group_.is_root()) estimated_worlds_.push_back({ids_[i], &world.model(), &world.estimated_state()});
  }
}

std::span<const stepping::LocalWorld> SpaceDriver::compute_estimate(std::int64_t, core::PhaseTimes& times) {
  for (const auto& world : worlds_) world->estimate(times);
  return estimated_worlds_;
}

core::Traffic SpaceDriver::take_traffic() {
  core::Traffic traffic;
  for (const auto& world : worlds_) {
    const core::Traffic own = world->take_traffic();
    traffic.messages += own.messages;
    traffic.bytes += own.bytes;
  }
  return traffic;
}

void SpaceDriver::advance(core::PhaseTimes& times) {
  for (const auto& world : worlds_) world->advance(times);
}

int SpaceDriver::lowest_nonfinite_world() const {
  for (std::size_t i = 0; group_.is_root() && i < worlds_.size(); ++i) {
    if (worlds_[i]->observables().nonfinite > 0) return ids_[i];
  }
  return settings().num_worlds;
}

std::vector<stepping::RunEvent> SpaceDriver::take_events() {
  std::vector<stepping::RunEvent> all;
  for (std::size_t i = 0; i < worlds_.size(); ++i) {
    for (stepping::RunEvent& event : worlds_[i]->take_events()) {
      event.world = ids_[i];
      all.push_back(std::move(event));
    }
  }
  return all;
}

void SpaceDriver::settle_events() {
  std::vector<char> is_mended;
  for (const auto& world : worlds_) is_mended.push_back(world->is_mended() ? 1 : 0);
  group_.bcast(std::span(is_mended));
  for (std::size_t i = 0; i < worlds_.size(); ++i) {
    if (is_mended[i] != 0) worlds_[i]->share_mended();
  }
}

/// Root of a group has all poses since the last step of the frame: SpaceStep sends them. Root of all plans
/// its own moves once the frame's time is taken, and learns here of the moves that the other groups plan.
void SpaceDriver::gather(core::PhaseTimes& times) {
  core::LapTimer timer(times);
  const std::vector<stepping::LocalWorld> worlds = local_worlds();
  std::vector<double> num_moves(worlds.size(), 0);
  for (std::size_t i = 0; !comm().is_root() && i < worlds.size(); ++i)
    num_moves[i] = static_cast<double>(worlds_[i]->plan_moves(true));
  gather_->gather(worlds, num_moves);
  timer.lap(core::Phase::gather);
}

std::int64_t SpaceDriver::plan_moves(bool last) {
  std::int64_t num_moves = 0;
  for (const auto& world : worlds_) num_moves += world->plan_moves(!last);
  for (const double of_another : gather_->number()) num_moves += static_cast<std::int64_t>(of_another);
  return last ? 0 : num_moves;
}

std::string SpaceDriver::make_moves(std::int64_t num_moves, std::int64_t) {
  for (const auto& world : worlds_) world->make_moves();
  if (!comm().is_root()) return "";
  if (settings().num_worlds == 1) return describe(worlds_.front()->planned());
  const auto moves = [](const auto& world) { return !world->planned().moves.empty(); };
  const auto num_own = std::ranges::count_if(worlds_, moves);
  const auto num_others = std::ranges::count_if(gather_->number(), [](double count) { return count > 0; });
  return describe_many(num_moves, num_own + num_others);
}

std::vector<model::State> SpaceDriver::gather_states() const {
  return mpi::gather_states(comm(), roots_,
                            [this](int world) -> const model::State& { return at(world).saved_state(); });
}

std::uint64_t SpaceDriver::state_hash() const {
  std::vector<std::uint64_t> own;
  for (const int world : group_.is_root() ? ids_ : std::vector<int>())
    own.push_back(model::hash(at(world).saved_state()));
  return gather_state_hash(comm(), roots_, own);
}

}  // namespace pbmpi::mpi
