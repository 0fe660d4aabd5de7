#include "mpi/spaces/plan/space_loads.h"

#include <algorithm>
#include <utility>

namespace pbmpi::mpi {
namespace {

/// Seconds of a frame under an ownership, lower is better.
double rating(const SpaceLoads& loads, std::span<const int> owner, int num_ranks) {
  const PredictedLoads load = predict_loads(loads, owner, num_ranks);
  const double longest = load.makespan_s();
  if (!(longest > 0)) return 0;
  // At equal makespans, less total work is better, as it ships less; and even loads are, since of several
  // ranks that take longest a change relieves one at a time.
  double sum = 0, squares = 0;
  for (const RankLoad& rank : load.ranks) {
    const double busy_s = rank.collide_s + rank.solve_s;
    sum += busy_s;
    squares += busy_s * busy_s;
  }
  return longest + 1e-3 * (sum + squares / longest);
}

/// Local search over ownerships.
class Search {
 public:
  Search(const SpaceLoads& loads, std::span<const int> owner, int num_ranks)
      : loads_(loads), num_ranks_(num_ranks), owner_(owner.begin(), owner.end()) {
    best_ = rating(loads_, owner_, num_ranks_);
  }

  /// The best single change; a swap only where nothing less helps. False if none does.
  bool improve() {
    found_.clear();
    find_longest();
    try_moves();
    try_islands();
    if (found_.empty()) try_swaps();  // far more of them than of the others
    if (found_.empty()) try_mirrors();
    if (found_.empty()) return false;
    owner_ = found_;
    return true;
  }
  const std::vector<int>& owner() const { return owner_; }

 private:
  void consider(const std::vector<int>& owner) {
    const double time = rating(loads_, owner, num_ranks_);
    if (time >= best_ * (1 - 1e-9)) return;
    best_ = time;
    found_ = owner;
  }
  /// The ranks for which others wait: no other change than one of theirs makes the frame shorter.
  void find_longest() {
    const PredictedLoads load = predict_loads(loads_, owner_, num_ranks_);
    constexpr double level = 1 - 1e-6;
    longest_.assign(load.ranks.size(), 0);
    const auto mark = [&](auto seconds) {
      const double most = seconds(*std::ranges::max_element(load.ranks, {}, seconds));
      for (std::size_t rank = 0; rank < load.ranks.size(); ++rank) {
        if (seconds(load.ranks[rank]) >= most * level) longest_[rank] = 1;
      }
    };
    mark([](const RankLoad& rank) { return rank.collide_s + rank.solve_s; });
    if (!load.ships) return;
    mark([](const RankLoad& rank) { return rank.collide_s; });
    mark([](const RankLoad& rank) { return rank.solve_s; });
  }
  bool is_longest(std::size_t space) const { return longest_[static_cast<std::size_t>(owner_[space])] != 0; }
  void try_moves() {
    for (std::size_t space = 0; space < owner_.size(); ++space) {
      if (!is_longest(space)) continue;
      for (int rank = 0; rank < num_ranks_; ++rank) {
        if (rank == owner_[space]) continue;
        std::vector<int> changed = owner_;
        changed[space] = rank;
        consider(changed);
      }
    }
  }
  void try_swaps() {
    constexpr std::size_t most_swaps = 4096;  // each is rated over all spaces
    std::size_t num_longest = 0;
    for (std::size_t space = 0; space < owner_.size(); ++space) num_longest += is_longest(space) ? 1 : 0;
    if (num_longest * owner_.size() > most_swaps) return;
    for (std::size_t a = 0; a < owner_.size(); ++a) {
      for (std::size_t b = a + 1; b < owner_.size(); ++b) {
        if (owner_[a] == owner_[b] || !(is_longest(a) || is_longest(b))) continue;
        std::vector<int> changed = owner_;
        std::swap(changed[a], changed[b]);
        consider(changed);
      }
    }
  }
  /// Swaps all spaces of two ranks: root may own the busiest ones, which leaves no time for its own section.
  void try_mirrors() {
    for (int a = 0; a < num_ranks_; ++a) {
      for (int b = a + 1; b < num_ranks_; ++b) {
        if (longest_[static_cast<std::size_t>(a)] == 0 && longest_[static_cast<std::size_t>(b)] == 0)
          continue;
        std::vector<int> changed = owner_;
        for (int& rank : changed) rank = rank == a ? b : rank == b ? a : rank;
        consider(changed);
      }
    }
  }
  void try_islands() {
    for (const std::vector<SpacePart>& island : loads_.islands) {
      for (int rank = 0; rank < num_ranks_; ++rank) {
        std::vector<int> changed = owner_;
        for (const SpacePart& part : island) changed[part.space] = rank;
        consider(changed);
      }
    }
  }

  const SpaceLoads& loads_;
  int num_ranks_;
  std::vector<int> owner_;
  double best_ = 0;
  std::vector<char> longest_;  ///< [num_ranks]
  std::vector<int> found_;     ///< the best change of this round; empty if there is none
};

}  // namespace

double PredictedLoads::makespan_s() const {
  double collide = 0, solve = 0, both = 0;
  for (const RankLoad& rank : ranks) {
    collide = std::max(collide, rank.collide_s);
    solve = std::max(solve, rank.solve_s);
    both = std::max(both, rank.collide_s + rank.solve_s);
  }
  return ships ? collide + solve : both;
}

void SolverWork::add(const SolverWork& other) {
  if (units.empty()) units.resize(other.units.size());
  for (std::size_t shape = 0; shape < other.units.size(); ++shape) units[shape] += other.units[shape];
  contacts_s += other.contacts_s;
  bodies += other.bodies;
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

/// Adds an island of several spaces to the rank that has most of its bodies, to which the other ranks ship
/// theirs.
void add_island(const SpaceLoads& loads, const std::vector<SpacePart>& island, std::span<const int> owner,
                std::vector<SolverWork>& work, PredictedLoads& load) {
  std::vector<int> bodies(work.size(), 0);
  for (const SpacePart& part : island) bodies[owner[part.space]] += part.work.bodies;
  const auto solver = std::max_element(bodies.begin(), bodies.end()) - bodies.begin();
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

PredictedLoads predict_loads(const SpaceLoads& loads, std::span<const int> owner, int num_ranks) {
  PredictedLoads load{std::vector<RankLoad>(static_cast<std::size_t>(num_ranks)), false};
  std::vector<SolverWork> work(load.ranks.size());
  load.ranks.front().collide_s = loads.root_extra_s;
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

Reassignment reassign_spaces(const SpaceLoads& loads, std::span<const int> owner, int num_ranks,
                             double threshold) {
  constexpr int most_changes = 1000;  // never reached, since each change lowers the rating
  Search search(loads, owner, num_ranks);
  for (int change = 0; change < most_changes && search.improve(); ++change) {
  }
  Reassignment result{{},
                      predict_loads(loads, owner, num_ranks).makespan_s(),
                      predict_loads(loads, search.owner(), num_ranks).makespan_s()};
  const double least_gain = (threshold - 1) / 2;
  if (result.makespan_before_s <= result.makespan_after_s * (1 + least_gain)) return result;
  for (std::size_t space = 0; space < owner.size(); ++space) {
    if (search.owner()[space] != owner[space])
      result.moves.push_back({static_cast<int>(space), search.owner()[space]});
  }
  return result;
}

}  // namespace pbmpi::mpi
