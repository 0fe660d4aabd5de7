#include "mpi/spaces/step/island_dispatch.h"

#include <utility>

#include "mpi/comm/message.h"

namespace pbmpi::mpi {

using core::Phase;

Orders IslandDispatch::dispatch(const LocalIslands& own, std::span<const model::Contact> crossing,
                                core::LapTimer& timer) {
  if (shared_->is_root()) {
    const std::vector<LocalIslands> reports = receive_reports(own, timer);
    std::vector<Orders> orders = plan(reports, crossing);
    post_orders(orders);
    timer.lap(Phase::cross_space);
    return std::move(orders.front());
  }
  post_report(own);
  timer.lap(Phase::gather);
  Orders orders = receive_orders();
  timer.lap(Phase::wait);
  return orders;
}

void IslandDispatch::post_report(const LocalIslands& own) {
  MessageWriter message;
  message.put(own.of_unit);
  message.put(own.weight);
  shared_->mail->post(message.take(), Communicator::root, report_tag);
}

std::vector<LocalIslands> IslandDispatch::receive_reports(const LocalIslands& own, core::LapTimer& timer) {
  std::vector<LocalIslands> reports(static_cast<std::size_t>(shared_->comm->size()));
  reports.front() = own;
  for (int rank = 1; rank < shared_->comm->size(); ++rank) {
    MessageReader message(shared_->mail->take(rank, report_tag));
    timer.lap(Phase::wait);
    const auto of_unit = message.get<std::int32_t>();
    const auto weight = message.get<std::int32_t>();
    reports[rank].of_unit.assign(of_unit.begin(), of_unit.end());
    reports[rank].weight.assign(weight.begin(), weight.end());
  }
  timer.lap(Phase::gather);
  return reports;
}

std::vector<Orders> IslandDispatch::plan(std::span<const LocalIslands> reports,
                                         std::span<const model::Contact> crossing) {
  const model::SpaceMap& map = shared_->stepper->map();
  std::vector<Orders> orders(reports.size());
  if (crossing.empty()) return orders;
  std::vector<IslandRef> island_of_unit(static_cast<std::size_t>(map.num_units()));
  for (int rank = 0; rank < shared_->comm->size(); ++rank) {
    const std::vector<int>& units = shared_->ownership->units[rank];
    for (std::size_t i = 0; i < units.size(); ++i)
      island_of_unit[units[i]] = {rank, reports[rank].of_unit[i]};
  }
  const auto island_of = [&](int body) { return island_of_unit[map.unit_of_body[body]]; };
  std::vector<IslandLink> links;
  links.reserve(crossing.size());
  for (const model::Contact& contact : crossing)
    links.push_back({island_of(contact.body_a), island_of(contact.body_b)});
  const IslandPlan plan = plan_islands(reports, links);
  for (const Transfer& transfer : plan.transfers) {
    std::vector<std::int32_t>& outgoing = orders[transfer.island.rank].outgoing;
    outgoing.push_back(transfer.island.island);
    outgoing.push_back(transfer.to);
    std::vector<std::int32_t>& arrivals = orders[transfer.to].arrivals;
    if (arrivals.empty() || arrivals.back() != transfer.island.rank) arrivals.push_back(transfer.island.rank);
  }
  for (std::size_t i = 0; i < crossing.size(); ++i)
    orders[plan.solver_of_link[i]].contacts.push_back(to_wire(crossing[i]));
  return orders;
}

void IslandDispatch::post_orders(std::span<const Orders> orders) {
  for (int rank = 1; rank < shared_->comm->size(); ++rank) {
    MessageWriter message;
    message.put(orders[rank].outgoing);
    message.put(orders[rank].arrivals);
    message.put(orders[rank].contacts);
    shared_->mail->post(message.take(), rank, orders_tag);
  }
}

Orders IslandDispatch::receive_orders() {
  MessageReader message(shared_->mail->take(Communicator::root, orders_tag));
  const auto outgoing = message.get<std::int32_t>();
  const auto arrivals = message.get<std::int32_t>();
  const auto contacts = message.get<WireContact>();
  return {{outgoing.begin(), outgoing.end()},
          {arrivals.begin(), arrivals.end()},
          {contacts.begin(), contacts.end()}};
}

}  // namespace pbmpi::mpi
