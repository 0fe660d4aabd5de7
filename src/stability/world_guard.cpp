#include "stability/world_guard.h"

#include <array>
#include <optional>
#include <utility>

#include "stability/finer_steps.h"

namespace pbmpi::stability {
namespace {

using model::State;
using model::Vec3;
using stepping::RunEvent;

constexpr std::array finer_choices = {2, 4, 8, 16};

Seen seen_of(const Watched& watched) { return {watched.state, watched.seen}; }

}  // namespace

/// A frame of one world that is stepped again, step by step.
class WorldGuard::Replay {
 public:
  /// `is_lost`: something is not finite at the end of the frame.
  Replay(const WorldGuard& guard, const Watched& start, std::int64_t first_step,
         const stepping::MotorTargets& targets, bool is_lost, std::vector<RunEvent>& events)
      : guard_(&guard),
        targets_(targets),
        now_(start),
        step_(first_step),
        is_lost_(is_lost),
        from_(start.state.position),
        events_(&events) {
    stepping::StepperSettings settings = guard.settings_->stepper;
    settings.profile = false;
    settings.contacts = false;
    stepper_ = guard.settings_->make_stepper(settings);
    add_aimed(*stepper_, guard.world_, guard.model_, targets, start.state, first_step);
  }

  /// False if nothing is left to do: a guard has tripped and only a report is asked for, or the world is
  /// frozen.
  bool step();

  bool has_tripped() const { return has_tripped_; }
  bool has_mended() const { return has_mended_; }
  const Watched& now() const { return now_; }

 private:
  std::optional<Trip> check(const Watched& next, model::GuardMemory& memory);
  void tell(const Trip& trip);
  bool mend(Watched& next);
  bool refine(Watched& next);
  void freeze();
  void go_on_from(Watched&& next);
  void tell(const char* kind, double value, const std::string& detail);

  const WorldGuard* guard_;
  stepping::MotorTargets targets_;  ///< for the present step
  Watched now_;
  std::int64_t step_;
  bool is_lost_;
  /// The point where the path of each centre begins: at now_, or further back for a centre inside a geom, so
  /// that a path through it is seen as a whole.
  std::vector<Vec3> from_;
  std::vector<Vec3> scratch_;
  std::vector<RunEvent>* events_;
  std::unique_ptr<stepping::WorldStepper> stepper_;
  bool has_tripped_ = false, has_mended_ = false;
};

bool WorldGuard::Replay::step() {
  core::PhaseTimes unused;
  stepper_->advance(1, unused);
  Watched next{stepper_->state(guard_->world_), stepper_->observables(guard_->world_)};
  model::GuardMemory memory = now_.state.guard;
  if (const auto trip = check(next, memory)) {
    if (mends(guard_->settings_->on_blowup)) {
      tell(*trip);
      if (!mend(next)) return false;
    } else {
      // The first guard that trips is reported, and a non-finite number always is: it ends the run.
      if (!has_tripped_ || trip->guard == Guard::nonfinite) tell(*trip);
      if (trip->guard == Guard::nonfinite || !is_lost_) return false;
    }
  } else {
    next.state.guard = memory;
  }
  go_on_from(std::move(next));
  return true;
}

std::optional<Trip> WorldGuard::Replay::check(const Watched& next, model::GuardMemory& memory) {
  const auto from = guard_->guards_.launched(from_, step_, 1, scratch_);
  return guard_->guards_.check({seen_of(now_), seen_of(next), step_, 1}, from, PassageFinder::Pace::any,
                               memory);
}

/// False if the world goes no further.
bool WorldGuard::Replay::mend(Watched& next) {
  has_mended_ = true;
  if (guard_->settings_->on_blowup == OnBlowup::refine && refine(next)) return true;
  freeze();
  return false;
}

/// Replaces the step with finer ones at which no guard trips, if there are any.
bool WorldGuard::Replay::refine(Watched& next) {
  for (const int finer : finer_choices) {
    FinerResult result =
        step_finer(*guard_->settings_, guard_->world_, *guard_->model_, targets_, now_.state, step_, finer);
    next = {std::move(result.state), result.seen};
    model::GuardMemory memory = now_.state.guard;
    if (check(next, memory)) continue;
    next.state.guard = memory;
    stepper_->set_state(guard_->world_, next.state, step_ + 1);
    tell(stepping::event_kind::refined, finer, "was done as " + std::to_string(finer) + " finer ones");
    return true;
  }
  return false;
}

void WorldGuard::Replay::freeze() {
  model::GuardMemory memory = now_.state.guard;
  memory.frozen_in = static_cast<std::int32_t>(step_);
  now_.state.guard = memory;
  tell(stepping::event_kind::frozen, 0, "and all after it are not done: the world stands still");
}

void WorldGuard::Replay::go_on_from(Watched&& next) {
  const std::vector<char> inside = guard_->guards_.passages().find_inside(next.state);
  for (int body = 0; body < next.state.num_bodies(); ++body) {
    if (inside[body] == 0) from_[body] = next.state.position[body];
  }
  now_ = std::move(next);
  targets_.pass(*guard_->model_, step_);
  ++step_;
}

void WorldGuard::Replay::tell(const Trip& trip) {
  has_tripped_ = true;
  events_->push_back(event_of(trip, guard_->world_, *guard_->model_));
}

void WorldGuard::Replay::tell(const char* kind, double value, const std::string& detail) {
  RunEvent event;
  event.kind = kind;
  event.detail = "world " + std::to_string(guard_->world_) + ": step " + std::to_string(step_) + " " + detail;
  event.step = step_;
  event.world = guard_->world_;
  event.value = value;
  events_->push_back(std::move(event));
}

WorldGuard::WorldGuard(int world, std::shared_ptr<const model::Model> model, const GuardSettings& settings)
    : world_(world),
      model_(std::move(model)),
      settings_(&settings),
      guards_(*model_, settings.stepper.dt_s, settings.limits) {}

/// In a frozen world only quantities that follow from its state are measured.
Watched WorldGuard::begin(const State& state) const {
  Watched watched{state, {}};
  observe_state(*model_, watched.state, watched.seen);
  if (!watched.is_frozen()) guards_.note_kinetic(watched.state, watched.seen.energy_j, watched.state.guard);
  return watched;
}

bool WorldGuard::end_frame(Watched& watched, const Reached& next, std::int64_t first_step, int num_steps,
                           std::vector<RunEvent>& events, const stepping::MotorTargets& targets) const {
  model::GuardMemory memory = watched.state.guard;
  std::vector<Vec3> scratch;
  const auto from = guards_.launched(watched.state.position, first_step, num_steps, scratch);
  const Guards::Span frame = {seen_of(watched), {next.state, next.seen}, first_step, num_steps};
  bool mended = false;
  if (guards_.check(frame, from, PassageFinder::Pace::fast, memory)) {
    Replay replay(*this, watched, first_step, targets, next.seen.nonfinite > 0, events);
    for (int i = 0; i < num_steps && replay.step(); ++i) continue;
    mended = replay.has_mended();
    if (mended) {
      watched = replay.now();
      if (watched.is_frozen()) {
        watched = begin(watched.state);
        return true;
      }
      memory = watched.state.guard;
    } else if (replay.has_tripped()) {
      // The next report covers energy gained from now on.
      if (memory.energy_gain_j > guards_.energy_limit(memory)) memory.energy_gain_j = 0;
    } else {
      memory = replay.now().state.guard;
    }
  }
  if (!mended) {
    watched.state = next.state;
    watched.seen = next.seen;
  }
  watched.state.guard = memory;
  if (watched.seen.nonfinite == 0)
    guards_.note_kinetic(watched.state, watched.seen.energy_j, watched.state.guard);
  return mended;
}

}  // namespace pbmpi::stability
