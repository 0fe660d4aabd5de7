#include "mpi/spaces/step/space_step.h"

#include <memory>

#include "effects/effects.h"

namespace pbmpi::mpi {

using core::Phase;

SpaceStep::SpaceStep(const Communicator& comm, stepping::SpaceStepper& stepper, ErrorHold& errors) {
  shared_.comm = &comm;
  shared_.stepper = &stepper;
  shared_.errors = &errors;
  shared_.sleepers = stepper.sleepers();
  shared_.field = stepper.field();
  if (comm.size() > 1) shared_.mail = std::make_unique<Mail>(comm);
}

void SpaceStep::own(const SpaceOwnership& ownership, const model::State& state, std::int64_t step) {
  shared_.ownership = ownership;
  const effects::StepPlan plan(shared_.stepper->model());
  shared_.has_fast_bodies = plan.has(effects::EffectId::fast_bodies);
  shared_.joints_break = plan.has(effects::EffectId::breakable_joints);
  shared_.remembers = shared_.stepper->remembers();
  shared_.records = shared_.stepper->shows_contacts();
  shared_.crosses = ownership.is_divided() && shared_.stepper->model().spaces_meet;
  work_.units = shared_.own_units();
  shared_.guard([&] { shared_.stepper->own(shared_.own_spaces(), state, step); });
  crossing_.own();
}

void SpaceStep::run(std::int64_t step, bool last, core::PhaseTimes& times) {
  core::LapTimer timer(times);
  islands_.start_step();
  crossing_.start_step();
  shared_.guard([&] { shared_.stepper->fire_events(step); });
  if (sleep_.sleeps_through(step)) return sleep_through(last, times);
  center_.post();
  crossing_.search_early(step, timer);
  const double began_s = core::now_s();
  shared_.guard([&] { shared_.stepper->collide(work_.contacts); });
  const double collided_s = core::now_s();
  timer.lap(Phase::collide);
  center_.take(timer);
  sleep_.wake_touched(step, work_.contacts, timer);
  if (shared_.crosses) exchange(step, timer);
  shared_.guard([&] { shared_.stepper->solve(work_.units, work_.contacts, step, times); });
  core::LapTimer after(times);
  if (shared_.crosses) shipping_.ship_back(after);
  crossing_.note_pace(began_s, collided_s);
  sleep_.put_resting_to_sleep(step, after);
  if (last) {
    report_frame(times);
  } else if (shared_.crosses && !shared_.is_root()) {
    crossing_.post_poses();
    after.lap(Phase::gather);
  }
}

/// Turns own contacts and own units into those of the islands that this rank solves.
void SpaceStep::exchange(std::int64_t step, core::LapTimer& timer) {
  shipping_.start_step();
  work_.units = shared_.own_units();
  if (!crossing_.finds_any(step, timer)) return;
  islands_.form(work_.contacts);
  timer.lap(Phase::islands);
  const Orders orders = dispatch_.dispatch(islands_.islands(), crossing_.contacts(), timer);
  shipping_.ship(orders, islands_.islands(), work_, timer);
}

/// A step in which all bodies sleep: nothing moves, and only the account of a frame is sent.
void SpaceStep::sleep_through(bool last, core::PhaseTimes& times) {
  core::LapTimer timer(times);
  work_.contacts.clear();
  work_.units = shared_.own_units();
  crossing_.skip_step(timer);
  if (last) report_frame(times);
}

void SpaceStep::report_frame(core::PhaseTimes& times) {
  report_.send(work_, shipping_.take_bodies_shipped(), times);
}

}  // namespace pbmpi::mpi
