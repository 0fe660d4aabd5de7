#include "mpi/spaces/step/frame_report.h"

#include <algorithm>
#include <iterator>
#include <utility>

#include "model/joint_gap.h"
#include "model/mechanics.h"
#include "model/state_parts.h"
#include "mpi/spaces/step/wire.h"
#include "stepping/observable_table.h"

namespace pbmpi::mpi {

using core::Phase;

namespace {

template <class Force>
void put_forces(const std::vector<Force>& forces, MessageWriter& message) {
  std::vector<double> rows;
  model::append_rows(forces, rows);
  message.put(rows);
}

void put_contacts(const stepping::StepContacts& shown, MessageWriter& message) {
  std::vector<WireContact> contacts;
  std::vector<model::ContactForce> forces;
  for (const model::LoadedContact& one : shown.contacts) {
    contacts.push_back(to_wire(one.contact));
    forces.push_back(one.force);
  }
  message.put(contacts);
  put_forces(forces, message);
  put_forces(shown.joints, message);
}

stepping::StepContacts read_contacts(MessageReader& message) {
  stepping::StepContacts shown;
  const std::span<const WireContact> contacts = message.get<WireContact>();
  const auto forces = model::take_rows<model::ContactForce>(message.get<double>());
  for (std::size_t i = 0; i < contacts.size(); ++i)
    shown.contacts.push_back({from_wire(contacts[i]), forces[i]});
  shown.joints = model::take_rows<model::JointForce>(message.get<double>());
  return shown;
}

/// The times less what other ranks and programs on the rank's cores took of them. `processor_s`: of the rank
/// in the same steps.
core::PhaseTimes undisturbed(const core::PhaseTimes& times, double processor_s) {
  core::PhaseTimes own = times;
  const double useful_s = times.useful_s();
  if (processor_s >= useful_s) return own;
  for (double& seconds : own.seconds) seconds *= processor_s / useful_s;
  return own;
}

}  // namespace

void FrameReport::send(const StepWork& work, std::int64_t bodies_shipped, core::PhaseTimes& times) {
  core::LapTimer timer(times);
  islands_->form(work.contacts);
  Account own;
  shared_->guard([&] { own.seen = shared_->stepper->count(work.units); });
  const std::vector<double> energy_j = own_energies();
  own.energy_j = energy_j;
  own.seen.joint_gap_m = own_joint_gap();
  timer.lap(Phase::islands);
  own.times = undisturbed(times, processor_time_s() - processor_before_s_);
  own.bodies_shipped = bodies_shipped;
  own.island_of_unit = islands_->islands().of_unit;
  own.unit_weight = islands_->unit_weight();
  own.unit_near = islands_->unit_near();
  own_contacts_.clear();
  if (shared_->records) shared_->guard([&] { own_contacts_ = shared_->stepper->contacts_of(work.units); });
  if (shared_->is_root()) return receive(own, timer);
  post(own);
  timer.lap(Phase::gather);
}

std::vector<double> FrameReport::own_energies() const {
  std::vector<double> energy_j;
  for (const int body : shared_->own_bodies())
    energy_j.push_back(model::body_energy(shared_->stepper->model(), shared_->stepper->state(), body));
  return energy_j;
}

double FrameReport::own_joint_gap() const {
  const model::Model& model = shared_->stepper->model();
  double largest_m = 0;
  const model::State& state = shared_->stepper->state();
  for (std::size_t i = 0; i < model.joints.size(); ++i) {
    const model::Joint& joint = model.joints[i];
    if (state.is_broken(i)) continue;
    if (shared_->ownership->owner[shared_->stepper->map().space_of_body(joint.body_a)] ==
        shared_->comm->rank())
      largest_m = std::max(largest_m, model::joint_gap(model, state, joint));
  }
  return largest_m;
}

void FrameReport::post(const Account& own) {
  if (!shared_->crosses) shared_->mail->finish();  // returns at once: root has the last frame's account
  MessageWriter message;
  message.put(model::body_rows(shared_->stepper->state(), shared_->own_bodies()));
  if (shared_->sleepers) message.put(shared_->sleepers->rest_rows(shared_->own_bodies()));
  shared_->put_units(shared_->own_units(), message);
  message.put(crossing_->own_boxes());
  message.put_value(own.seen);
  message.put(own.energy_j);
  message.put_value(own.times);
  message.put_value(own.bodies_shipped);
  message.put(own.island_of_unit);
  message.put(own.unit_weight);
  if (shared_->field != nullptr) message.put(own.unit_near);
  if (shared_->records) put_contacts(own_contacts_, message);
  shared_->mail->post(message.take(), Communicator::root, frame_tag);
}

void FrameReport::take_rows(int rank, MessageReader& message) {
  const SpaceOwnership& ownership = *shared_->ownership;
  shared_->stepper->put_states(ownership.bodies[rank], message.get<double>());
  if (shared_->sleepers) shared_->sleepers->put(ownership.bodies[rank], message.get<double>());
  shared_->take_units(ownership.units[rank], message);
  crossing_->put_boxes(rank, message.get<geometry::Box>());
}

FrameReport::Account FrameReport::read_account(MessageReader& message) const {
  Account account;
  account.seen = message.get_value<stepping::Observables>();
  account.energy_j = message.get<double>();
  account.times = message.get_value<core::PhaseTimes>();
  account.bodies_shipped = message.get_value<std::int64_t>();
  account.island_of_unit = message.get<std::int32_t>();
  account.unit_weight = message.get<std::int32_t>();
  if (shared_->field != nullptr) account.unit_near = message.get<char>();
  return account;
}

void FrameReport::receive(const Account& own, core::LapTimer& timer) {
  clear();
  model::DisjointSets islands(shared_->stepper->map().num_units());
  add(Communicator::root, own, islands);
  take_contacts(own_contacts_);
  for (int rank = 1; rank < shared_->comm->size(); ++rank) {
    MessageReader message(shared_->mail->take(rank, frame_tag));
    timer.lap(Phase::wait);
    take_rows(rank, message);
    add(rank, read_account(message), islands);
    if (shared_->records) take_contacts(read_contacts(message));
    timer.lap(Phase::gather);
  }
  crossing_->note_whole_state();
  // The scene's promise that spaces never meet is relied on in each step, and checked once a frame.
  if (!shared_->crosses && shared_->ownership->is_divided())
    shared_->guard([&] { crossing_->require_apart(); });
  join_islands(islands);
  timer.lap(Phase::islands);
}

void FrameReport::clear() {
  findings_ = {};
  findings_.energy_j.resize(shared_->stepper->model().bodies.size());
  findings_.weight.resize(static_cast<std::size_t>(shared_->stepper->map().num_units()));
  if (shared_->field != nullptr) findings_.near.resize(findings_.weight.size());
  findings_.times.resize(static_cast<std::size_t>(shared_->comm->size()));
}

void FrameReport::add(int rank, const Account& account, model::DisjointSets& islands) {
  const std::vector<int>& bodies = shared_->ownership->bodies[rank];
  const std::vector<int>& units = shared_->ownership->units[rank];
  stepping::join(findings_.seen, account.seen);
  for (std::size_t i = 0; i < bodies.size(); ++i) findings_.energy_j[bodies[i]] = account.energy_j[i];
  findings_.times[rank] = account.times;
  findings_.bodies_shipped += account.bodies_shipped;
  std::vector<int> lowest_unit(units.size(), -1);  // [islands of the rank], which are at most its units
  for (std::size_t i = 0; i < units.size(); ++i) {
    findings_.weight[units[i]] = account.unit_weight[i];
    if (shared_->field != nullptr) findings_.near[units[i]] = account.unit_near[i];
    int& lowest = lowest_unit[account.island_of_unit[i]];
    if (lowest < 0) lowest = units[i];
    islands.unite(lowest, units[i]);
  }
}

/// One rank solves all contacts of a pair of geoms, in their order; one rank also solves each joint.
void FrameReport::take_contacts(const stepping::StepContacts& part) {
  const stepping::StepContacts earlier = std::exchange(findings_.contacts, {});
  stepping::StepContacts& all = findings_.contacts;
  std::ranges::merge(
      earlier.contacts, part.contacts, std::back_inserter(all.contacts), {},
      [](const model::LoadedContact& one) { return one.contact.geoms; },
      [](const model::LoadedContact& one) { return one.contact.geoms; });
  all.joints = earlier.joints.empty() ? part.joints : earlier.joints;
  for (std::size_t joint = 0; joint < part.joints.size(); ++joint) {
    const model::JointForce& force = part.joints[joint];
    std::array<double, model::row_width<model::JointForce>> row;
    model::put_row(force, row.data());
    const bool acts = std::ranges::any_of(row, [](double number) { return number != 0; });
    if (acts) all.joints[joint] = force;
  }
}

/// Joins the ranks' islands by the contacts across spaces. Where nothing can cross, these contacts are what
/// require_apart() found, and end the run.
void FrameReport::join_islands(model::DisjointSets& islands) {
  const model::SpaceMap& map = shared_->stepper->map();
  if (shared_->crosses) {
    for (const model::Contact& contact : crossing_->contacts()) {
      const int unit = map.unit_of_body[contact.body_a];
      islands.unite(unit, map.unit_of_body[contact.body_b]);
      findings_.weight[unit] += model::contact_rows(contact.mu);
    }
  }
  for (int unit = 0; unit < map.num_units(); ++unit) findings_.island.push_back(islands.find(unit));
  std::vector<char> near(findings_.near.size(), 0);  // one flag per island, at its lowest unit
  for (std::size_t unit = 0; unit < near.size(); ++unit) near[findings_.island[unit]] |= findings_.near[unit];
  for (std::size_t unit = 0; unit < near.size(); ++unit) findings_.near[unit] = near[findings_.island[unit]];
}

}  // namespace pbmpi::mpi
