#include "mpi/spaces/space_driver.h"

#include <algorithm>
#include <cstdio>
#include <numeric>
#include <utility>

#include "core/error.h"
#include "mpi/frame/whole_state.h"
#include "mpi/spaces/step/wire.h"

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
std::vector<int> all_of(int count) {
  std::vector<int> numbers(static_cast<std::size_t>(count));
  std::iota(numbers.begin(), numbers.end(), 0);
  return numbers;
}

/// Root's array, on every rank.
std::vector<double> shared(const Communicator& comm, std::vector<double> packed) {
  std::int64_t size = std::ssize(packed);
  comm.bcast_value(size);
  packed.resize(static_cast<std::size_t>(size));
  comm.bcast(std::span(packed));
  return packed;
}

/// The state that a resumed run starts from: root's, on every rank. Throws unless it fits the model.
model::State resumed_state(const Communicator& comm, const model::Model& model,
                           std::span<const model::State> states) {
  std::vector<double> packed;
  agree_on_errors(comm, [&] {
    if (!comm.is_root()) return;
    if (states.size() != 1)
      throw core::RunError("a world cut into spaces starts from the state of one world, not of " +
                           std::to_string(states.size()) + "; resume a run of one world");
    require_fit(0, states.front(), model);
    packed = pack(states.front());
  });
  return unpack(shared(comm, std::move(packed)));
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
      steps_done_(settings.first_step()),
      rebalancer_(stepper, settings.steps_per_frame, settings.rebalance_threshold) {
  core::require_invariant(settings.num_worlds == 1, "SpaceDriver: one world");
  table_.body_offset.push_back(stepper.model().num_bodies());
  const model::State start = steps_done_ == 0 ? model::initial_state(stepper.model())
                                              : resumed_state(this->comm(), stepper.model(), states);
  is_frozen_ = start.guard.frozen_in >= 0;
  now_.state = start;
  step_.own(ownership_, start, steps_done_);
  agree(this->comm(), errors());
}

void SpaceDriver::watch(const stability::GuardSettings& settings) {
  if (!comm().is_root()) return;
  // The stepper, which is borrowed, keeps the model for as long.
  guard_.emplace(this->settings().first_world,
                 std::shared_ptr<const model::Model>(std::shared_ptr<void>(), &stepper_->model()), settings);
  now_ = guard_->begin(now_.state);
  observables_ = now_.seen;
}

std::vector<stepping::LocalWorld> SpaceDriver::local_worlds() const {
  if (!comm().is_root()) return {};
  const bool stands = is_frozen_ || !stepper_->shows_contacts();
  return {{0, &stepper_->model(), &stepper_->state(), &observables_, nullptr,
           stands ? nullptr : &step_.findings().contacts}};
}

std::vector<int> SpaceDriver::idle_ranks() const {
  std::vector<int> idle;
  for (int rank = 0; rank < comm().size(); ++rank) {
    if (ownership_.bodies[rank].empty()) idle.push_back(rank);
  }
  return idle;
}

void SpaceDriver::estimate_with(stepping::SpaceStepper& stepper, std::optional<double> due_s) {
  estimate_ = std::make_unique<SpaceEstimate>(comm(), stepper, errors(), settings().steps_per_frame,
                                              settings().dt_s, due_s);
  if (comm().is_root()) estimated_worlds_ = {{0, &stepper_->model(), &estimate_->state()}};
}

double SpaceDriver::make_estimate(std::int64_t frame, double frame_start_s, core::PhaseTimes& times) {
  if (!estimate_) return 0;
  const double start_s = core::now_s();
  estimate_frame(times);
  estimate_record_.compute_s = core::now_s() - start_s;
  estimate_record_.steps = estimate_->steps();
  if (!comm().is_root()) return 0;
  const double delivered_s = core::now_s() - frame_start_s;
  hand_to_consumers(frame, stepping::PoseKind::estimate, estimate_->state().position,
                    estimate_->state().orientation);
  return delivered_s;
}

void SpaceDriver::estimate_frame(core::PhaseTimes& times) {
  if (is_frozen_) return estimate_->take(stepper_->state());
  switch (estimate_->choose()) {
    case SpaceEstimate::How::precise:
      advance(times);
      is_advanced_ = true;
      return estimate_->take(stepper_->state());
    case SpaceEstimate::How::coarse:
      return estimate_->run(ownership_, stepper_->state(), steps_done_, times);
    case SpaceEstimate::How::glide:
      return estimate_->glide(stepper_->state());
  }
}

const stepping::EstimateRecord* SpaceDriver::estimate(double delivered_s) {
  if (!estimate_) return nullptr;
  estimate_record_.worlds = estimated_worlds_;
  estimate_record_.delivered_s = delivered_s;
  return &estimate_record_;
}

core::Traffic SpaceDriver::take_traffic() {
  core::Traffic traffic = step_.take_traffic();
  if (!estimate_) return traffic;
  const core::Traffic of_estimate = estimate_->take_traffic();
  traffic.messages += of_estimate.messages;
  traffic.bytes += of_estimate.bytes;
  return traffic;
}

void SpaceDriver::advance(core::PhaseTimes& times) {
  if (std::exchange(is_advanced_, false)) return;
  if (is_frozen_) {
    steps_done_ += settings().steps_per_frame;
  } else {
    step_frame(times);
  }
}

void SpaceDriver::step_frame(core::PhaseTimes& times) {
  const double start_s = core::now_s();
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
  rebalancer_.note_times(step_.findings());
  end_watched_frame();
  observing.lap(Phase::islands);
  if (estimate_) estimate_->note_precise(core::now_s() - start_s);
}

void SpaceDriver::observe() {
  const FrameFindings& found = step_.findings();
  observables_ = found.seen;
  // In the order of the bodies, so that the sum is that of model::mechanical_energy(), bit for bit.
  observables_.energy_j = std::accumulate(found.energy_j.begin(), found.energy_j.end(), 0.0);
  stepping::observe_bodies(stepper_->model(), stepper_->state(), observables_);
}

void SpaceDriver::end_watched_frame() {
  if (!guard_ || errors().failed()) return;
  std::swap(before_, now_);
  now_.state = stepper_->state();
  now_.seen = observables_;
  const int num_steps = settings().steps_per_frame;
  errors().guard(
      [&] { is_mended_ = guard_->end_frame(before_, steps_done_ - num_steps, num_steps, now_, events_); });
  observables_ = now_.seen;
}

/// What root has made of the world replaces the state of every rank.
void SpaceDriver::settle_events() {
  enum What : std::int32_t { nothing, mended, frozen };
  std::int32_t what = is_mended_ ? (now_.is_frozen() ? frozen : mended) : nothing;
  comm().bcast_value(what);
  if (what == nothing) return;
  const model::State state =
      unpack(shared(comm(), comm().is_root() ? pack(now_.state) : std::vector<double>()));
  step_.own(ownership_, state, steps_done_);
  is_frozen_ = what == frozen;
  is_mended_ = false;
}

/// On root.
const model::State& SpaceDriver::whole_state() const { return guard_ ? now_.state : stepper_->state(); }

int SpaceDriver::lowest_nonfinite_world() const {
  return comm().is_root() && observables_.nonfinite > 0 ? 0 : settings().num_worlds;
}

std::int64_t SpaceDriver::count_nonfinite(int) const { return observables_.nonfinite; }
int SpaceDriver::reporter_of(int) const { return Communicator::root; }

/// Root has all poses since the last step of the frame: SpaceStep sends them.
void SpaceDriver::gather(core::PhaseTimes&) {}

std::int64_t SpaceDriver::plan_moves(bool last) {
  planned_ = {};
  if (is_frozen_) return 0;  // nothing was measured
  planned_ = rebalancer_.decide(step_.findings(), ownership_, comm().size() > 1 && !last);
  return std::ssize(planned_.moves);
}

std::string SpaceDriver::make_moves(std::int64_t num_moves, std::int64_t step) {
  planned_.moves.resize(num_moves);
  comm().bcast(std::span(planned_.moves));
  broadcast_state();
  std::vector<int> owner = ownership_.owner;
  for (const Move& move : planned_.moves) owner[move.part] = move.to;
  ownership_ = SpaceOwnership(stepper_->map(), std::move(owner), comm().size());
  const model::State state = stepper_->state();
  step_.own(ownership_, state, step);
  rebalancer_.forget_times();
  return describe(planned_);
}

/// Root's whole state replaces that of every rank, so that any rank can own any space.
void SpaceDriver::broadcast_state() {
  const int num_bodies = stepper_->model().num_bodies();
  const std::vector<int> bodies = all_of(num_bodies);
  std::vector<double> rows(model::numbers_of_state * static_cast<std::size_t>(num_bodies));
  if (comm().is_root()) rows = state_rows(stepper_->state(), bodies);
  comm().bcast(std::span(rows));
  stepper_->put_states(bodies, rows);
  if (effects::SpaceSleepers* sleepers = stepper_->sleepers()) {
    std::vector<double> rest = sleepers->rest_rows(bodies);
    comm().bcast(std::span(rest));
    sleepers->put(bodies, rest);
  }
  const std::vector<int> units = all_of(stepper_->map().num_units());
  std::vector<std::int32_t> broken = stepper_->broken_rows(units);
  if (!broken.empty()) {
    comm().bcast(std::span(broken));
    stepper_->put_broken(units, broken);
  }
  if (stepper_->remembers()) {
    const bool has_rows = comm().is_root();
    stepper_->put_memory(units,
                         shared(comm(), has_rows ? stepper_->memory_rows(units) : std::vector<double>()));
  }
}

/// Root has the whole state since the last step of the frame.
std::vector<model::State> SpaceDriver::gather_states() const {
  if (!comm().is_root()) return {};
  return {whole_state()};
}

std::uint64_t SpaceDriver::state_hash() const {
  std::uint64_t hash = 0;
  if (comm().is_root()) {
    const std::uint64_t world = model::hash(whole_state());
    hash = combine_world_hashes(std::span(&world, 1));
  }
  comm().bcast_value(hash);
  return hash;
}

}  // namespace pbmpi::mpi
