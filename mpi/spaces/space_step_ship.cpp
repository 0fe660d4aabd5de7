/// Islands on their way to the rank that solves them, and back.
#include "mpi/spaces/space_step.h"

#include <algorithm>

namespace pbmpi::mpi {

using core::Phase;
using model::Contact;

void SpaceStep::ship(const Orders& orders, core::LapTimer& timer) {
  if (orders.outgoing.empty() && orders.contacts.empty()) {
    if (active_units_ != own_units()) active_units_ = own_units();
    return;
  }
  active_units_ = own_units();
  if (!orders.outgoing.empty()) ship_out(orders);
  ship_in(orders, timer);
  merge_contacts(orders.contacts, contacts_);
  std::sort(active_units_.begin(), active_units_.end());
  timer.lap(Phase::ship);
}

void SpaceStep::ship_out(const Orders& orders) {
  const model::SpaceMap& map = stepper_->map();
  std::vector<int> to_of_island(islands_.weight.size(), comm_->rank());
  for (std::size_t i = 0; i < orders.outgoing.size(); i += 2)
    to_of_island[orders.outgoing[i]] = orders.outgoing[i + 1];
  std::vector<int> to_of_unit(static_cast<std::size_t>(map.num_units()), comm_->rank());
  std::vector<std::vector<int>> units(static_cast<std::size_t>(comm_->size()));
  for (std::size_t i = 0; i < own_units().size(); ++i) {
    const int unit = own_units()[i];
    to_of_unit[unit] = to_of_island[islands_.of_unit[i]];
    units[to_of_unit[unit]].push_back(unit);
  }
  std::vector<std::vector<WireContact>> contacts(static_cast<std::size_t>(comm_->size()));
  const auto destination = [&](const Contact& contact) {
    return to_of_unit[map.unit_of_body[contact.body_a]];
  };
  for (const Contact& contact : contacts_) {
    const int to = destination(contact);
    if (to != comm_->rank()) contacts[to].push_back(to_wire(contact));
  }
  std::erase_if(contacts_, [&](const Contact& contact) { return destination(contact) != comm_->rank(); });
  active_units_ = units[comm_->rank()];
  for (int to = 0; to < comm_->size(); ++to) {
    if (to == comm_->rank() || units[to].empty()) continue;
    MessageWriter message;
    message.put(units[to]);
    const std::vector<int> bodies = bodies_of(map, units[to]);
    bodies_shipped_ += std::ssize(bodies);
    message.put(state_rows(stepper_->state(), bodies));
    if (joints_break_) message.put(stepper_->broken_rows(units[to]));
    message.put(contacts[to]);
    mail_->post(message.take(), to, ship_tag);
    guests_elsewhere_.push_back({to, std::move(units[to])});
  }
}

void SpaceStep::ship_in(const Orders& orders, core::LapTimer& timer) {
  for (const int from : orders.arrivals) {
    timer.lap(Phase::ship);
    MessageReader message(mail_->take(from, ship_tag));
    timer.lap(Phase::wait);
    const auto units = message.get<int>();
    const auto rows = message.get<double>();
    if (joints_break_) stepper_->put_broken(units, message.get<std::int32_t>());
    merge_contacts(message.get<WireContact>(), contacts_);
    guests_.push_back({from, {units.begin(), units.end()}});
    stepper_->put_states(bodies_of(stepper_->map(), units), rows);
    active_units_.insert(active_units_.end(), units.begin(), units.end());
  }
}

void SpaceStep::ship_back(core::LapTimer& timer) {
  const model::SpaceMap& map = stepper_->map();
  for (const Shipment& guest : guests_) {
    MessageWriter message;
    const std::vector<int> bodies = bodies_of(map, guest.units);
    message.put(state_rows(stepper_->state(), bodies));
    if (joints_break_) message.put(stepper_->broken_rows(guest.units));
    mail_->post(message.take(), guest.rank, back_tag);
    timer.lap(Phase::ship);
  }
  for (const Shipment& shipped : guests_elsewhere_) {
    MessageReader message(mail_->take(shipped.rank, back_tag));
    timer.lap(Phase::wait);
    stepper_->put_states(bodies_of(map, shipped.units), message.get<double>());
    if (joints_break_) stepper_->put_broken(shipped.units, message.get<std::int32_t>());
    timer.lap(Phase::ship);
  }
}

}  // namespace pbmpi::mpi
