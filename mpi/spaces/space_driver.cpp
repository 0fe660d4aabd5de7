#include "mpi/spaces/space_driver.h"

#include <algorithm>
#include <cstdio>
#include <map>
#include <numeric>
#include <utility>

#include "core/error.h"
#include "mpi/frame/whole_state.h"
#include "mpi/spaces/wire.h"

namespace pbmpi::mpi {

using core::Phase;

namespace {

std::string describe(const Reassignment& plan) {
  char text[96];
  std::snprintf(text, sizeof text, "%zu space%s moved: busiest rank %.3f -> %.3f ms a frame",
                plan.moves.size(), plan.moves.size() == 1 ? "" : "s", 1e3 * plan.makespan_before_s,
                1e3 * plan.makespan_after_s);
  return text;
}

/// 0, 1, ... count - 1: all bodies, or all units.
std::vector<int> first_numbers(int count) {
  std::vector<int> numbers(static_cast<std::size_t>(count));
  std::iota(numbers.begin(), numbers.end(), 0);
  return numbers;
}

/// Root's one state, on every rank. Throws unless it fits the model.
model::State share_state(const Communicator& comm, const model::Model& model,
                         std::span<const model::State> states) {
  std::vector<double> packed;
  agree_on_errors(comm, [&] {
    if (!comm.is_root()) return;
    if (states.size() != 1) throw core::RunError("there is not one state to start from");
    require_fit(0, states.front(), model);
    packed = pack(states.front());
  });
  std::int64_t size = std::ssize(packed);
  comm.bcast_value(size);
  packed.resize(static_cast<std::size_t>(size));
  comm.bcast(std::span(packed));
  return unpack(packed);
}

}  // namespace

std::vector<int> initial_owners(const model::SpaceMap& map, int num_ranks) {
  std::vector<double> cost;
  for (const std::vector<int>& units : map.units_of_space) {
    double rows = 0;
    for (const int unit : units)
      rows += map.rows_of_unit[unit] + static_cast<double>(map.bodies_of_unit[unit].size());
    cost.push_back(rows);
  }
  return lpt_placement(cost, num_ranks);
}

SpaceDriver::SpaceDriver(const Communicator& comm, stepping::SpaceStepper& stepper,
                         const WorldRunSettings& settings, std::span<const model::State> states)
    : FrameDriver(comm, settings, stepper.map().num_spaces()),
      stepper_(&stepper),
      ownership_(stepper.map(),
                 settings.placement.empty() ? initial_owners(stepper.map(), comm.size()) : settings.placement,
                 comm.size()),
      step_(this->comm(), stepper, errors()),
      steps_done_(settings.first_step()) {
  core::require_invariant(settings.num_worlds == 1, "SpaceDriver: one world");
  table_.body_offset.push_back(stepper.model().num_bodies());
  const model::State start = steps_done_ == 0 ? model::initial_state(stepper.model())
                                              : share_state(this->comm(), stepper.model(), states);
  step_.own(ownership_, start, steps_done_);
  agree(this->comm(), errors());
}

std::vector<stepping::LocalWorld> SpaceDriver::local_worlds() const {
  if (!comm().is_root()) return {};
  return {{0, &stepper_->model(), &stepper_->state(), &observables_}};
}

std::vector<int> SpaceDriver::idle_ranks() const {
  std::vector<int> idle;
  for (int rank = 0; rank < comm().size(); ++rank) {
    if (ownership_.bodies[rank].empty()) idle.push_back(rank);
  }
  return idle;
}

void SpaceDriver::advance(core::PhaseTimes& times) {
  core::LapTimer timer(times);
  // A rank without bodies only waits for the others, whatever the phases in which it does so.
  const bool idle = !comm().is_root() && ownership_.bodies[comm().rank()].empty();
  core::PhaseTimes unused;
  for (int i = 0; i < settings().steps_per_frame; ++i) {
    step_.run(steps_done_, i + 1 == settings().steps_per_frame, idle ? unused : times);
    if (hook_) hook_(steps_done_, step_.contacts());
    ++steps_done_;
  }
  if (idle) timer.lap(Phase::wait);
  if (!comm().is_root()) return;
  core::LapTimer observing(times);
  observe();
  note_times();
  observing.lap(Phase::islands);
}

void SpaceDriver::note_times() {
  if (last_times_.size() == frames_looked_at) last_times_.erase(last_times_.begin());
  last_times_.push_back(step_.findings().times);
}

std::vector<core::PhaseTimes> SpaceDriver::quiet_times() const {
  std::vector<core::PhaseTimes> least = last_times_.front();
  for (const std::vector<core::PhaseTimes>& frame : last_times_) {
    for (std::size_t rank = 0; rank < least.size(); ++rank) {
      for (std::size_t phase = 0; phase < core::num_phases; ++phase)
        least[rank].seconds[phase] = std::min(least[rank].seconds[phase], frame[rank].seconds[phase]);
    }
  }
  return least;
}

void SpaceDriver::observe() {
  const FrameFindings& found = step_.findings();
  observables_ = found.seen;
  // In the order of the bodies, so that the sum is that of model::mechanical_energy(), bit for bit.
  observables_.energy_j = std::accumulate(found.energy_j.begin(), found.energy_j.end(), 0.0);
  stepping::observe_bodies(stepper_->model(), stepper_->state(), observables_);
}

int SpaceDriver::lowest_nonfinite_world() const {
  return comm().is_root() && observables_.nonfinite > 0 ? 0 : settings().num_worlds;
}

std::int64_t SpaceDriver::count_nonfinite(int) const { return observables_.nonfinite; }
int SpaceDriver::reporter_of(int) const { return Communicator::root; }

/// Root got everything with the last step.
void SpaceDriver::gather(core::PhaseTimes&) {}

/// Seconds of a rank in the solver, in one frame.
static double solver_s(const core::PhaseTimes& times) {
  return times[Phase::rows] + times[Phase::solve] + times[Phase::integrate];
}

/// The seconds of collision go to the spaces of the rank that spent them, by contact rows and bodies; those
/// of the solver to batches of equal units and to contacts, by their rows, over all ranks (an island costs
/// the same anywhere).
SpaceLoads SpaceDriver::loads() const {
  const FrameFindings& found = step_.findings();
  const std::vector<core::PhaseTimes> times = quiet_times();
  const model::SpaceMap& map = stepper_->map();
  const effects::FieldOfInterest* field = stepper_->field();
  const std::size_t num_spaces = ownership_.owner.size();
  const auto num_shapes = static_cast<std::size_t>(map.num_shapes());
  SpaceLoads loads;
  loads.num_lanes = stepper_->num_lanes();
  // Units of a shape that get few iterations are solved apart from the others: they count as other shapes.
  const std::size_t num_sorts = field == nullptr ? 1 : 2;
  loads.batch_s.assign(num_sorts * num_shapes, 0);
  loads.inside.assign(num_spaces, {std::vector<int>(num_sorts * num_shapes, 0), 0, 0});
  std::vector<double> space_weight(num_spaces, 0), rank_weight(ownership_.spaces.size(), 0);
  std::map<int, std::map<int, SpacePart>> islands;  // by island and space; weights instead of seconds
  for (int unit = 0; unit < map.num_units(); ++unit) {
    const int space = map.space_of_unit[unit];
    const auto bodies = static_cast<int>(map.bodies_of_unit[unit].size());
    const double contact_rows = found.weight[unit] - map.rows_of_unit[unit] - bodies;
    const bool inside = field == nullptr || found.near[unit];
    const double share = inside ? 1 : field->outside_share();
    const std::size_t shape = map.shape_of_unit[unit] + (inside ? 0 : num_shapes);
    loads.batch_s[shape] = share * loads.num_lanes * (map.rows_of_unit[unit] + bodies);
    SpacePart& part = islands[found.island[unit]][space];
    part.space = space;
    part.work.units.resize(loads.batch_s.size());
    ++part.work.units[shape];
    part.work.contacts_s += share * contact_rows;
    part.work.bodies += bodies;
    space_weight[space] += contact_rows + bodies;
    rank_weight[ownership_.owner[space]] += contact_rows + bodies;
  }
  for (const auto& [island, parts] : islands) {
    if (parts.size() == 1) {
      loads.inside[parts.begin()->first].add(parts.begin()->second.work);
      continue;
    }
    std::vector<SpacePart>& shared = loads.islands.emplace_back();
    for (const auto& [space, part] : parts) shared.push_back(part);
  }
  for (std::size_t space = 0; space < num_spaces; ++space) {
    const int owner = ownership_.owner[space];
    const double rank_s = times[owner][Phase::collide] + times[owner][Phase::islands];
    loads.collide_s.push_back(rank_weight[owner] > 0 ? rank_s * space_weight[space] / rank_weight[owner] : 0);
  }
  scale_to_seconds(loads, times);
  return loads;
}

namespace {

/// Of each rank's solver: `loads` in weights.
std::vector<RankSample> samples_of(const SpaceLoads& loads, const std::vector<int>& owner,
                                   std::span<const core::PhaseTimes> times) {
  const auto num_ranks = static_cast<int>(times.size());
  SpaceLoads no_contacts = loads, no_batches = loads;
  no_contacts.scale({1, 0});
  no_batches.scale({0, 1});
  const PredictedLoads batches = predict_loads(no_contacts, owner, num_ranks);
  const PredictedLoads contacts = predict_loads(no_batches, owner, num_ranks);
  std::vector<RankSample> samples;
  for (std::size_t rank = 0; rank < times.size(); ++rank)
    samples.push_back({batches.ranks[rank].solve_s, contacts.ranks[rank].solve_s, solver_s(times[rank])});
  return samples;
}

}  // namespace

/// From weights to the seconds that the frame took with the present owners.
void SpaceDriver::scale_to_seconds(SpaceLoads& loads, std::span<const core::PhaseTimes> times) const {
  const FrameFindings& found = step_.findings();
  loads.scale(fit_costs(samples_of(loads, ownership_.owner, times)));
  double ship_s = 0;
  for (const core::PhaseTimes& rank : times) ship_s += rank[Phase::ship];
  loads.root_extra_s = times.front()[Phase::cross_space];
  if (found.bodies_shipped > 0) {
    loads.ship_s = settings().steps_per_frame * ship_s / (2.0 * static_cast<double>(found.bodies_shipped));
  }
}

std::int64_t SpaceDriver::plan_moves(bool last) {
  planned_ = {};
  frames_until_decision_ = std::max(0, frames_until_decision_ - 1);
  if (comm().size() == 1 || last || frames_until_decision_ > 0) return 0;
  planned_ = reassign_spaces(loads(), ownership_.owner, comm().size(), settings().rebalance_threshold);
  if (!planned_.moves.empty()) frames_until_decision_ = frames_between_decisions + 1;
  return std::ssize(planned_.moves);
}

std::string SpaceDriver::make_moves(std::int64_t num_moves, std::int64_t step) {
  planned_.moves.resize(num_moves);
  comm().bcast(std::span(planned_.moves));
  const int num_bodies = stepper_->model().num_bodies();
  const std::vector<int> bodies = first_numbers(num_bodies);
  std::vector<double> rows(model::numbers_of_state * static_cast<std::size_t>(num_bodies));
  if (comm().is_root()) rows = state_rows(stepper_->state(), bodies);
  comm().bcast(std::span(rows));
  std::vector<int> owner = ownership_.owner;
  for (const Move& move : planned_.moves) owner[move.part] = move.to;
  ownership_ = SpaceOwnership(stepper_->map(), std::move(owner), comm().size());
  stepper_->put_states(bodies, rows);
  if (effects::SpaceSleepers* sleepers = stepper_->sleepers()) {
    std::vector<double> rest = sleepers->rest_rows(bodies);
    comm().bcast(std::span(rest));
    sleepers->put(bodies, rest);
  }
  const std::vector<int> units = first_numbers(stepper_->map().num_units());
  std::vector<std::int32_t> broken = stepper_->broken_rows(units);
  if (!broken.empty()) {
    comm().bcast(std::span(broken));
    stepper_->put_broken(units, broken);
  }
  const model::State state = stepper_->state();
  step_.own(ownership_, state, step);
  last_times_.clear();
  return describe(planned_);
}

/// Root got everything with the last step of the frame.
std::vector<model::State> SpaceDriver::gather_states() const {
  if (!comm().is_root()) return {};
  return {stepper_->state()};
}

std::uint64_t SpaceDriver::state_hash() const {
  std::uint64_t hash = 0;
  if (comm().is_root()) {
    const std::uint64_t world = model::hash(stepper_->state());
    hash = combine_world_hashes(std::span(&world, 1));
  }
  comm().bcast_value(hash);
  return hash;
}

}  // namespace pbmpi::mpi
