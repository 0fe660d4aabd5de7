#include "mpi/spaces/plan/load_ledger.h"

#include <algorithm>
#include <cstddef>

namespace pbmpi::mpi {

namespace {

/// As PredictedLoads::makespan_s(), of any ranks with these two times.
double makespan_of(const auto& ranks, bool ships) {
  double collide = 0, solve = 0, both = 0;
  for (const auto& rank : ranks) {
    collide = std::max(collide, rank.collide_s);
    solve = std::max(solve, rank.solve_s);
    both = std::max(both, rank.collide_s + rank.solve_s);
  }
  return ships ? collide + solve : both;
}

}  // namespace

double PredictedLoads::makespan_s() const { return makespan_of(ranks, ships); }

PredictedLoads predict_loads(const SpaceLoads& loads, std::span<const int> owner, int num_ranks) {
  return LoadLedger(loads, owner, num_ranks).loads();
}

LoadLedger::LoadLedger(const SpaceLoads& loads, std::span<const int> owner, int num_ranks)
    : loads_(loads), islands_of_space_(owner.size()), bodies_(num_ranks, 0) {
  for (std::size_t island = 0; island < loads.islands.size(); ++island) {
    for (const SpacePart& part : loads.islands[island])
      islands_of_space_[part.space].push_back(static_cast<int>(island));
  }
  set(owner);
}

void LoadLedger::set(std::span<const int> owner) {
  owner_.assign(owner.begin(), owner.end());
  ranks_.assign(bodies_.size(), {});
  for (Rank& rank : ranks_) rank.work.units.assign(loads_.batch_s.size(), 0);
  ranks_.front().collide_s = loads_.root_extra_s;
  num_shipped_ = 0;
  for (std::size_t space = 0; space < loads_.borders.size(); ++space) put_border(static_cast<int>(space), 1);
  for (std::size_t space = 0; space < owner_.size(); ++space) put_space(static_cast<int>(space), 1);
  for (std::size_t island = 0; island < loads_.islands.size(); ++island)
    put_island(static_cast<int>(island), 1);
  for (Rank& rank : ranks_) rank.solve_s = loads_.seconds(rank.work) + rank.ship_s;
}

PredictedLoads LoadLedger::loads() const {
  PredictedLoads loads{{}, num_shipped_ > 0};
  loads.ranks.reserve(ranks_.size());
  for (const Rank& rank : ranks_) loads.ranks.push_back({rank.collide_s, rank.solve_s});
  return loads;
}

bool LoadLedger::ships(int island) const {
  const std::vector<SpacePart>& parts = loads_.islands[island];
  return std::ranges::any_of(
      parts, [&](const SpacePart& part) { return owner_[part.space] != owner_[parts.front().space]; });
}

double LoadLedger::rating() const {
  double sum = 0, squares = 0;
  for (const Rank& rank : ranks_) {
    const double busy_s = rank.collide_s + rank.solve_s;
    sum += busy_s;
    squares += busy_s * busy_s;
  }
  const double longest = makespan_of(ranks_, num_shipped_ > 0);
  if (!(longest > 0)) return 0;
  // At equal makespans, less total work is better, as it ships less; and even loads are, since of several
  // ranks that take longest a change relieves one at a time.
  return longest + 1e-3 * (sum + squares / longest);
}

double LoadLedger::rating_after(std::span<const Move> moves) {
  const int num_shipped = num_shipped_;
  find_touched(moves);
  put(moves, -1);
  before_.clear();
  for (const Move& move : moves) before_.push_back(std::exchange(owner_[move.part], move.to));
  put(moves, 1);
  for (const auto& [rank, as_before] : saved_)
    ranks_[rank].solve_s = loads_.seconds(ranks_[rank].work) + ranks_[rank].ship_s;
  const double result = rating();
  for (std::size_t i = moves.size(); i-- > 0;) owner_[moves[i].part] = before_[i];
  for (auto& [rank, as_before] : saved_) ranks_[rank] = std::move(as_before);
  num_shipped_ = num_shipped;
  return result;
}

/// Finds the islands and borders that the moves change, and saves the ranks that these concern.
void LoadLedger::find_touched(std::span<const Move> moves) {
  saved_.clear();
  islands_.clear();
  borders_.clear();
  keep(0);  // root
  for (const Move& move : moves) {
    const std::vector<int>& islands = islands_of_space_[move.part];
    islands_.insert(islands_.end(), islands.begin(), islands.end());
    keep(owner_[move.part]);
    keep(move.to);
    if (loads_.borders.empty()) continue;
    const std::vector<int>& neighbours = loads_.borders[move.part].neighbours;
    borders_.insert(borders_.end(), neighbours.begin(), neighbours.end());
    borders_.push_back(move.part);
  }
  for (std::vector<int>* touched : {&islands_, &borders_}) {
    std::ranges::sort(*touched);
    touched->erase(std::unique(touched->begin(), touched->end()), touched->end());
  }
  for (const int island : islands_) {
    for (const SpacePart& part : loads_.islands[island]) keep(owner_[part.space]);
  }
}

void LoadLedger::keep(int rank) {
  if (std::ranges::none_of(saved_, [&](const auto& kept) { return kept.first == rank; }))
    saved_.emplace_back(rank, ranks_[rank]);
}

/// Adds the moved spaces and what they touch under the present owners, or takes them away with `sign` -1.
void LoadLedger::put(std::span<const Move> moves, int sign) {
  for (const Move& move : moves) put_space(move.part, sign);
  for (const int island : islands_) put_island(island, sign);
  for (const int space : borders_) put_border(space, sign);
}

void LoadLedger::put_border(int space, int sign) {
  if (is_near_others(loads_.borders[space].neighbours, owner_, space))
    ranks_.front().collide_s += sign * loads_.cross_s * loads_.borders[space].bodies;
}

void LoadLedger::put_space(int space, int sign) {
  Rank& rank = ranks_[owner_[space]];
  rank.collide_s += sign * loads_.collide_s[space];
  rank.work.add(loads_.inside[space], sign);
}

void LoadLedger::put_island(int island, int sign) {
  const std::vector<SpacePart>& parts = loads_.islands[island];
  const int solver = solver_of(parts, owner_, bodies_);
  bool is_shipped = false;
  for (const SpacePart& part : parts) {
    ranks_[solver].work.add(part.work, sign);
    const int home = owner_[part.space];
    if (home == solver) continue;
    is_shipped = true;
    ranks_[solver].ship_s += sign * loads_.ship_s * part.work.bodies;
    ranks_[home].ship_s += sign * loads_.ship_s * part.work.bodies;
  }
  if (is_shipped) num_shipped_ += sign;
}

}  // namespace pbmpi::mpi
