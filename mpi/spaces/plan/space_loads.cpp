#include "mpi/spaces/plan/space_loads.h"

#include <algorithm>
#include <utility>

namespace pbmpi::mpi {

double PredictedLoads::makespan_s() const {
  double collide = 0, solve = 0, both = 0;
  for (const RankLoad& rank : ranks) {
    collide = std::max(collide, rank.collide_s);
    solve = std::max(solve, rank.solve_s);
    both = std::max(both, rank.collide_s + rank.solve_s);
  }
  return ships ? collide + solve : both;
}

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

namespace {

void add_island(const SpaceLoads& loads, const std::vector<SpacePart>& island, std::span<const int> owner,
                std::vector<SolverWork>& work, PredictedLoads& load) {
  std::vector<int> bodies(work.size(), 0);
  const int solver = solver_of(island, owner, bodies);
  for (const SpacePart& part : island) {
    work[solver].add(part.work);
    const int home = owner[part.space];
    if (home == solver) continue;
    load.ships = true;
    load.ranks[solver].solve_s += loads.ship_s * part.work.bodies;
    load.ranks[home].solve_s += loads.ship_s * part.work.bodies;
  }
}

}  // namespace

bool is_near_others(std::span<const int> neighbours, std::span<const int> owner, int space) {
  return std::ranges::any_of(neighbours, [&](int other) { return owner[other] != owner[space]; });
}

PredictedLoads predict_loads(const SpaceLoads& loads, std::span<const int> owner, int num_ranks) {
  PredictedLoads load{std::vector<RankLoad>(static_cast<std::size_t>(num_ranks)), false};
  std::vector<SolverWork> work(load.ranks.size());
  load.ranks.front().collide_s = loads.root_extra_s;
  for (std::size_t space = 0; space < loads.borders.size(); ++space) {
    if (is_near_others(loads.borders[space].neighbours, owner, static_cast<int>(space)))
      load.ranks.front().collide_s += loads.cross_s * loads.borders[space].bodies;
  }
  for (std::size_t space = 0; space < owner.size(); ++space) {
    load.ranks[owner[space]].collide_s += loads.collide_s[space];
    work[owner[space]].add(loads.inside[space]);
  }
  for (const std::vector<SpacePart>& island : loads.islands) add_island(loads, island, owner, work, load);
  for (std::size_t rank = 0; rank < work.size(); ++rank)
    load.ranks[rank].solve_s += loads.seconds(work[rank]);
  return load;
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
