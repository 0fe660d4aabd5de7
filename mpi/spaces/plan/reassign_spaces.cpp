#include "mpi/spaces/plan/reassign_spaces.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <utility>

namespace pbmpi::mpi {
namespace {

/// The loads of an ownership, and what a few moves would make of its rating.
class Ledger {
 public:
  Ledger(const SpaceLoads& loads, std::span<const int> owner, int num_ranks)
      : loads_(loads), islands_of_space_(owner.size()), bodies_(num_ranks, 0) {
    for (std::size_t island = 0; island < loads.islands.size(); ++island) {
      for (const SpacePart& part : loads.islands[island])
        islands_of_space_[part.space].push_back(static_cast<int>(island));
    }
    set(owner);
  }

  void set(std::span<const int> owner) {
    owner_.assign(owner.begin(), owner.end());
    ranks_.assign(bodies_.size(), {});
    for (Rank& rank : ranks_) rank.work.units.assign(loads_.batch_s.size(), 0);
    ranks_.front().collide_s = loads_.root_extra_s;
    num_shipped_ = 0;
    for (std::size_t space = 0; space < loads_.borders.size(); ++space)
      put_border(static_cast<int>(space), 1);
    for (std::size_t space = 0; space < owner_.size(); ++space) put_space(static_cast<int>(space), 1);
    for (std::size_t island = 0; island < loads_.islands.size(); ++island)
      put_island(static_cast<int>(island), 1);
    for (Rank& rank : ranks_) rank.solve_s = loads_.seconds(rank.work) + rank.ship_s;
  }
  const std::vector<int>& owner() const { return owner_; }
  bool ships(int island) const {
    const std::vector<SpacePart>& parts = loads_.islands[island];
    return std::ranges::any_of(
        parts, [&](const SpacePart& part) { return owner_[part.space] != owner_[parts.front().space]; });
  }

  /// Lower is better.
  double rating() const {
    double collide = 0, solve = 0, both = 0, sum = 0, squares = 0;
    for (const Rank& rank : ranks_) {
      const double busy_s = rank.collide_s + rank.solve_s;
      collide = std::max(collide, rank.collide_s);
      solve = std::max(solve, rank.solve_s);
      both = std::max(both, busy_s);
      sum += busy_s;
      squares += busy_s * busy_s;
    }
    const double longest = num_shipped_ > 0 ? collide + solve : both;
    if (!(longest > 0)) return 0;
    // At equal makespans, less total work is better, as it ships less; and even loads are, since of several
    // ranks that take longest a change relieves one at a time.
    return longest + 1e-3 * (sum + squares / longest);
  }

  /// The rating after these moves, which are undone again.
  double rating_after(std::span<const Move> moves) {
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

 private:
  struct Rank {
    double collide_s = 0;
    SolverWork work;
    double ship_s = 0;
    double solve_s = 0;  ///< shipping included
  };

  /// Finds the islands and borders that the moves change, and saves the ranks that these concern.
  void find_touched(std::span<const Move> moves) {
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
  void keep(int rank) {
    if (std::ranges::none_of(saved_, [&](const auto& kept) { return kept.first == rank; }))
      saved_.emplace_back(rank, ranks_[rank]);
  }
  /// Adds the moved spaces and what they touch under the present owners, or takes them away with `sign` -1.
  void put(std::span<const Move> moves, int sign) {
    for (const Move& move : moves) put_space(move.part, sign);
    for (const int island : islands_) put_island(island, sign);
    for (const int space : borders_) put_border(space, sign);
  }
  void put_border(int space, int sign) {
    if (is_near_others(loads_.borders[space].neighbours, owner_, space))
      ranks_.front().collide_s += sign * loads_.cross_s * loads_.borders[space].bodies;
  }
  void put_space(int space, int sign) {
    Rank& rank = ranks_[owner_[space]];
    rank.collide_s += sign * loads_.collide_s[space];
    rank.work.add(loads_.inside[space], sign);
  }
  void put_island(int island, int sign) {
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

  const SpaceLoads& loads_;
  std::vector<std::vector<int>> islands_of_space_;
  std::vector<int> owner_;
  std::vector<Rank> ranks_;
  int num_shipped_ = 0;  ///< islands
  // Scratch.
  std::vector<int> bodies_;             ///< [num_ranks] zeros
  std::vector<int> islands_, borders_;  ///< that the moves touch
  std::vector<int> before_;
  std::vector<std::pair<int, Rank>> saved_;
};

/// Local search over ownerships, which ends at the latest when it has rated `most_ratings` of them.
class Search {
 public:
  Search(const SpaceLoads& loads, std::span<const int> owner, int num_ranks, int most_ratings)
      : loads_(loads),
        num_ranks_(num_ranks),
        most_ratings_(most_ratings),
        ledger_(loads, owner, num_ranks),
        best_(ledger_.rating()) {}

  /// The best single change; a swap only where nothing less helps. False if none does.
  bool improve() {
    if (num_ratings_ >= most_ratings_) return false;
    found_.clear();
    find_longest();
    try_moves();
    try_islands();
    if (found_.empty()) try_swaps();  // far more of them than of the others
    if (found_.empty()) try_mirrors();
    if (found_.empty()) return false;
    std::vector<int> changed = owner();
    for (const Move& move : found_) changed[move.part] = move.to;
    ledger_.set(changed);
    return true;
  }
  const std::vector<int>& owner() const { return ledger_.owner(); }

 private:
  static constexpr double least_gain = 1e-6;  ///< of a change, relative

  void consider(std::span<const Move> moves) {
    ++num_ratings_;
    const double time = ledger_.rating_after(moves);
    if (time >= best_ * (1 - least_gain)) return;
    best_ = time;
    found_.assign(moves.begin(), moves.end());
  }
  /// The ranks for which others wait: no other change than one of theirs makes the frame shorter.
  void find_longest() {
    const PredictedLoads load = predict_loads(loads_, owner(), num_ranks_);
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
  int num_spaces() const { return static_cast<int>(owner().size()); }
  bool is_longest(int space) const { return longest_[owner()[space]] != 0; }
  void try_moves() {
    for (int space = 0; space < num_spaces(); ++space) {
      if (!is_longest(space)) continue;
      for (int rank = 0; rank < num_ranks_; ++rank) {
        if (rank != owner()[space]) consider(std::array{Move{space, rank}});
      }
    }
  }
  void try_swaps() {
    int num_longest = 0;
    for (int space = 0; space < num_spaces(); ++space) num_longest += is_longest(space) ? 1 : 0;
    if (num_longest * num_spaces() > most_ratings_ - num_ratings_) return;
    for (int a = 0; a < num_spaces(); ++a) {
      for (int b = a + 1; b < num_spaces(); ++b) {
        if (owner()[a] == owner()[b] || !(is_longest(a) || is_longest(b))) continue;
        consider(std::array{Move{a, owner()[b]}, Move{b, owner()[a]}});
      }
    }
  }
  /// Swaps all spaces of two ranks: root may own the busiest ones, which leaves no time for its own section.
  void try_mirrors() {
    for (int a = 0; a < num_ranks_; ++a) {
      for (int b = a + 1; b < num_ranks_; ++b) {
        if (longest_[a] == 0 && longest_[b] == 0) continue;
        std::vector<Move> moves;
        for (int space = 0; space < num_spaces(); ++space) {
          const int rank = owner()[space];
          if (rank == a || rank == b) moves.push_back({space, rank == a ? b : a});
        }
        consider(moves);
      }
    }
  }
  /// Brings islands of several spaces together, on any rank; those that are so only from a rank for which
  /// others wait.
  void try_islands() {
    for (std::size_t island = 0; island < loads_.islands.size(); ++island) {
      const std::vector<SpacePart>& parts = loads_.islands[island];
      const auto is_on_longest = [&](const SpacePart& part) { return is_longest(part.space); };
      if (!ledger_.ships(static_cast<int>(island)) && std::ranges::none_of(parts, is_on_longest)) continue;
      for (int rank = 0; rank < num_ranks_; ++rank) {
        std::vector<Move> moves;
        for (const SpacePart& part : parts) {
          if (owner()[part.space] != rank) moves.push_back({part.space, rank});
        }
        if (!moves.empty()) consider(moves);
      }
    }
  }

  const SpaceLoads& loads_;
  int num_ranks_, most_ratings_;
  Ledger ledger_;
  double best_ = 0;
  int num_ratings_ = 0;
  std::vector<char> longest_;  ///< [num_ranks]
  std::vector<Move> found_;    ///< the best change of this round; empty if there is none
};

}  // namespace

Reassignment reassign_spaces(const SpaceLoads& loads, std::span<const int> owner, int num_ranks,
                             double threshold) {
  constexpr int most_changes = 1000;  // never reached, since each change lowers the rating
  const double least_gain = (threshold - 1) / 2;
  const PredictedLoads now = predict_loads(loads, owner, num_ranks);
  double mean_s = 0;
  for (const RankLoad& rank : now.ranks) mean_s += (rank.collide_s + rank.solve_s) / num_ranks;
  if (!now.ships && now.makespan_s() <= mean_s * (1 + least_gain))
    return {{}, now.makespan_s(), now.makespan_s()};
  // Some 10 ms of root's time, and more where there is much to gain: a little can be found in a later frame.
  const double most_ratings = 1e4 * std::max(1.0, 8 * (now.makespan_s() / mean_s - 1));
  Search search(loads, owner, num_ranks, static_cast<int>(std::min(most_ratings, 1e6)));
  for (int change = 0; change < most_changes && search.improve(); ++change) {
  }
  Reassignment result{{}, now.makespan_s(), predict_loads(loads, search.owner(), num_ranks).makespan_s()};
  if (result.makespan_before_s <= result.makespan_after_s * (1 + least_gain)) return result;
  for (std::size_t space = 0; space < owner.size(); ++space) {
    if (search.owner()[space] != owner[space])
      result.moves.push_back({static_cast<int>(space), search.owner()[space]});
  }
  return result;
}

}  // namespace pbmpi::mpi
