#include "mpi/spaces/step/space_step.h"

#include <algorithm>
#include <memory>

#include "effects/effects.h"
#include "effects/motors.h"
#include "mpi/comm/message.h"

namespace pbmpi::mpi {

using core::Phase;

using effects::BodyPair;

using effects::Resting;

bool SleepAgreement::sleeps_through(std::int64_t step) {
  if (shared_->sleepers == nullptr) return false;
  shared_->sleepers->wake_called(step);
  return shared_->sleepers->all_asleep();
}

void SleepAgreement::wake_touched(std::int64_t step, std::vector<model::Contact>& contacts,
                                  core::LapTimer& timer) {
  if (shared_->sleepers == nullptr) return;
  const bool searches = shared_->crosses && shared_->is_root();
  for (bool first = true;; first = false) {
    if (!first) shared_->guard([&] { shared_->stepper->collide(contacts); });
    timer.lap(Phase::collide);
    std::vector<int> islands;
    if (searches) crossing_->search(step, timer);
    shared_->guard([&] {
      islands = shared_->sleepers->islands_touched(contacts);
      if (!searches) return;
      const std::vector<int> across = shared_->sleepers->islands_touched(crossing_->contacts());
      islands.insert(islands.end(), across.begin(), across.end());
    });
    if (shared_->crosses) {
      islands = shared_->comm->allgatherv(std::span<const int>(islands));
      std::sort(islands.begin(), islands.end());
      timer.lap(Phase::wait);
    }
    if (!shared_->sleepers->wake(islands)) break;
  }
  touching_ = effects::touching_bodies(contacts);
}

void SleepAgreement::put_resting_to_sleep(std::int64_t step, core::LapTimer& timer) {
  if (shared_->sleepers == nullptr) return;
  const auto is_driven = [&](int joint) {
    return effects::is_driven_before(shared_->stepper->model(), step + 1, joint);
  };
  std::vector<Resting> resting;
  shared_->guard(
      [&] { resting = shared_->sleepers->find_resting(shared_->own_bodies(), touching_, is_driven); });
  timer.lap(Phase::islands);
  if (shared_->crosses) {
    resting = shared_->comm->allgatherv(std::span<const Resting>(resting));
    timer.lap(Phase::wait);
  }
  if (!resting.empty()) resting = join(resting);
  shared_->sleepers->put_to_sleep(resting);
}

/// Joins the ranks' parts of islands by the contacts across spaces, which only root knows.
std::vector<Resting> SleepAgreement::join(std::span<const Resting> resting) {
  std::vector<int> across;  // two bodies per contact
  if (shared_->crosses && shared_->is_root()) {
    for (const model::Contact& contact : crossing_->contacts()) {
      across.push_back(contact.body_a);
      across.push_back(contact.body_b);
    }
  }
  if (shared_->crosses) across = shared_->comm->allgatherv(std::span<const int>(across));
  std::vector<BodyPair> touching;
  for (std::size_t i = 0; i < across.size(); i += 2) touching.emplace_back(across[i], across[i + 1]);
  return effects::Sleepers::join(shared_->stepper->model().num_bodies(), resting, touching);
}

int FieldCenter::owner() const {
  if (shared_->field == nullptr || shared_->field->follows() == model::no_body) return -1;
  return shared_->ownership->owner[shared_->stepper->map().space_of_body(shared_->field->follows())];
}

void FieldCenter::post() {
  const Communicator& comm = *shared_->comm;
  if (owner() != comm.rank()) return;
  const model::Vec3& center = shared_->stepper->state().position[shared_->field->follows()];
  shared_->field->set_center(center);
  // Where nothing crosses no verdict ends a step; the messages of the previous step have been received by
  // now.
  if (!shared_->crosses && shared_->mail) shared_->mail->finish();
  for (int rank = 0; shared_->ownership->is_divided() && rank < comm.size(); ++rank) {
    if (rank == comm.rank()) continue;
    MessageWriter message;
    message.put(std::span<const double>(center.data(), 3));
    shared_->mail->post(message.take(), rank, center_tag);
  }
}

void FieldCenter::take(core::LapTimer& timer) {
  const int from = owner();
  if (from < 0 || from == shared_->comm->rank() || !shared_->ownership->is_divided()) return;
  MessageReader message(shared_->mail->take(from, center_tag));
  const auto center = message.get<double>();
  shared_->field->set_center({center[0], center[1], center[2]});
  timer.lap(core::Phase::wait);
}

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
  if (sleep_.sleeps_through(step)) return sleep_through(step, last, times);
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
    crossing_.post_border(step + 1);
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
void SpaceStep::sleep_through(std::int64_t step, bool last, core::PhaseTimes& times) {
  core::LapTimer timer(times);
  work_.contacts.clear();
  work_.units = shared_.own_units();
  crossing_.skip_step(step, timer);
  if (last) report_frame(times);
}

void SpaceStep::report_frame(core::PhaseTimes& times) {
  report_.send(work_, shipping_.take_bodies_shipped(), times);
}

}  // namespace pbmpi::mpi
