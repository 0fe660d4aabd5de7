#include "mpi/spaces/step/island_shipping.h"

#include <algorithm>

#include "model/state_parts.h"
#include "mpi/comm/message.h"
#include "mpi/spaces/step/wire.h"

namespace pbmpi::mpi {

using core::Phase;
using model::Contact;

void IslandShipping::start_step() {
  guests_.clear();
  away_.clear();
}

void IslandShipping::ship(const Orders& orders, const LocalIslands& own, StepWork& work,
                          core::LapTimer& timer) {
  if (orders.outgoing.empty() && orders.contacts.empty()) return;
  if (!orders.outgoing.empty()) send(orders, own, work);
  receive(orders, work, timer);
  merge_contacts(orders.contacts, work.contacts);
  std::sort(work.units.begin(), work.units.end());
  timer.lap(Phase::ship);
}

void IslandShipping::send(const Orders& orders, const LocalIslands& own, StepWork& work) {
  const int num_ranks = shared_->comm->size(), here = shared_->comm->rank();
  const model::SpaceMap& map = shared_->stepper->map();
  const std::vector<int>& own_units = shared_->own_units();
  std::vector<int> to_of_island(own.weight.size(), here);
  for (std::size_t i = 0; i < orders.outgoing.size(); i += 2)
    to_of_island[orders.outgoing[i]] = orders.outgoing[i + 1];
  std::vector<int> to_of_unit(static_cast<std::size_t>(map.num_units()), here);
  std::vector<std::vector<int>> units(static_cast<std::size_t>(num_ranks));
  for (std::size_t i = 0; i < own_units.size(); ++i) {
    const int unit = own_units[i];
    to_of_unit[unit] = to_of_island[own.of_unit[i]];
    units[to_of_unit[unit]].push_back(unit);
  }
  std::vector<std::vector<WireContact>> contacts(static_cast<std::size_t>(num_ranks));
  const auto destination = [&](const Contact& contact) {
    return to_of_unit[map.unit_of_body[contact.body_a]];
  };
  for (const Contact& contact : work.contacts) {
    const int to = destination(contact);
    if (to != here) contacts[to].push_back(to_wire(contact));
  }
  std::erase_if(work.contacts, [&](const Contact& contact) { return destination(contact) != here; });
  work.units = units[here];
  for (int to = 0; to < num_ranks; ++to) {
    if (to == here || units[to].empty()) continue;
    MessageWriter message;
    message.put(units[to]);
    const std::vector<int> bodies = bodies_of(map, units[to]);
    bodies_shipped_ += std::ssize(bodies);
    message.put(model::body_rows(shared_->stepper->state(), bodies));
    shared_->put_units(units[to], message);
    message.put(contacts[to]);
    shared_->mail->post(message.take(), to, ship_tag);
    away_.push_back({to, std::move(units[to])});
  }
}

void IslandShipping::receive(const Orders& orders, StepWork& work, core::LapTimer& timer) {
  for (const int from : orders.arrivals) {
    timer.lap(Phase::ship);
    MessageReader message(shared_->mail->take(from, ship_tag));
    timer.lap(Phase::wait);
    const auto units = message.get<int>();
    const auto rows = message.get<double>();
    shared_->take_units(units, message);
    merge_contacts(message.get<WireContact>(), work.contacts);
    guests_.push_back({from, {units.begin(), units.end()}});
    shared_->stepper->put_states(bodies_of(shared_->stepper->map(), units), rows);
    work.units.insert(work.units.end(), units.begin(), units.end());
  }
}

void IslandShipping::ship_back(core::LapTimer& timer) {
  const model::SpaceMap& map = shared_->stepper->map();
  for (const Shipment& guest : guests_) {
    MessageWriter message;
    message.put(model::body_rows(shared_->stepper->state(), bodies_of(map, guest.units)));
    shared_->put_units(guest.units, message);
    shared_->mail->post(message.take(), guest.rank, back_tag);
    timer.lap(Phase::ship);
  }
  for (const Shipment& shipped : away_) {
    MessageReader message(shared_->mail->take(shipped.rank, back_tag));
    timer.lap(Phase::wait);
    shared_->stepper->put_states(bodies_of(map, shipped.units), message.get<double>());
    shared_->take_units(shipped.units, message);
    timer.lap(Phase::ship);
  }
}

}  // namespace pbmpi::mpi
