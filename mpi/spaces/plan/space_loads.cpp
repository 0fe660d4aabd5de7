#include "mpi/spaces/plan/space_loads.h"

#include <algorithm>

namespace pbmpi::mpi {

void SolverWork::add(const SolverWork& other, int sign) {
  if (units.empty()) units.resize(other.units.size());
  for (std::size_t shape = 0; shape < other.units.size(); ++shape) units[shape] += sign * other.units[shape];
  contacts_s += sign * other.contacts_s;
  bodies += sign * other.bodies;
}

int solver_of(std::span<const SpacePart> island, std::span<const int> owner, std::span<int> scratch) {
  int solver = owner[island.front().space];
  for (const SpacePart& part : island) scratch[owner[part.space]] += part.work.bodies;
  for (const SpacePart& part : island) {
    const int rank = owner[part.space];
    if (scratch[rank] > scratch[solver] || (scratch[rank] == scratch[solver] && rank < solver)) solver = rank;
  }
  for (const SpacePart& part : island) scratch[owner[part.space]] = 0;
  return solver;
}

double SpaceLoads::seconds(const SolverWork& work) const {
  double sum = work.contacts_s;
  for (std::size_t shape = 0; shape < work.units.size(); ++shape) {
    const int batches = (work.units[shape] + num_lanes - 1) / num_lanes;
    sum += batch_s[shape] * batches;
  }
  return sum;
}

void SpaceLoads::scale(const SolverCosts& costs) {
  for (double& batch : batch_s) batch *= costs.batches;
  for (SolverWork& work : inside) work.contacts_s *= costs.contacts;
  for (std::vector<SpacePart>& island : islands) {
    for (SpacePart& part : island) part.work.contacts_s *= costs.contacts;
  }
}

bool is_near_others(std::span<const int> neighbours, std::span<const int> owner, int space) {
  return std::ranges::any_of(neighbours, [&](int other) { return owner[other] != owner[space]; });
}

SolverCosts fit_costs(std::span<const RankSample> ranks) {
  double bb = 0, bc = 0, cc = 0, bt = 0, ct = 0, weight = 0, seconds = 0;
  for (const RankSample& rank : ranks) {
    bb += rank.batches * rank.batches;
    bc += rank.batches * rank.contacts;
    cc += rank.contacts * rank.contacts;
    bt += rank.batches * rank.seconds;
    ct += rank.contacts * rank.seconds;
    weight += rank.batches + rank.contacts;
    seconds += rank.seconds;
  }
  if (weight <= 0) return {};
  const double common = seconds / weight;
  const double determinant = bb * cc - bc * bc;
  constexpr double least_independence = 0.02;  // of the squared sine between the two columns
  if (determinant <= least_independence * bb * cc) return {common, common};
  // Lanes make the rows of joints cheaper than those of contacts, by at most the number of lanes; and neither
  // is free, whatever a noisy frame suggests.
  constexpr double most = 4;
  const double batch = std::clamp((bt * cc - ct * bc) / determinant, common / most, common * most);
  const double contact = std::clamp((ct * bb - bt * bc) / determinant, common / most, common * most);
  return {batch, contact};
}

}  // namespace pbmpi::mpi
