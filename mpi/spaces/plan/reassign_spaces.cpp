#include "mpi/spaces/plan/reassign_spaces.h"

#include <algorithm>
#include <array>
#include <cstddef>

#include "mpi/spaces/plan/load_ledger.h"

namespace pbmpi::mpi {
namespace {

/// Local search over ownerships.
class Search {
 public:
  Search(const SpaceLoads& loads, std::span<const int> owner, int num_ranks)
      : loads_(loads), num_ranks_(num_ranks), ledger_(loads, owner, num_ranks), best_(ledger_.rating()) {}

  /// Makes changes until none helps, or until it has rated `most_ratings` of them.
  void run(int most_ratings) {
    most_ratings_ = most_ratings;
    while (num_ratings_ < most_ratings_ && improve()) {
    }
  }
  const std::vector<int>& owner() const { return ledger_.owner(); }
  PredictedLoads predicted() const { return ledger_.loads(); }

 private:
  static constexpr double least_improvement = 1e-6;  ///< of a change, relative

  /// The best single change; a swap only where nothing less helps. False if none does.
  bool improve() {
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
  void consider(std::span<const Move> moves) {
    ++num_ratings_;
    const double time = ledger_.rating_after(moves);
    if (time >= best_ * (1 - least_improvement)) return;
    best_ = time;
    found_.assign(moves.begin(), moves.end());
  }
  /// The ranks for which others wait: no other change than one of theirs makes the frame shorter.
  void find_longest() {
    const PredictedLoads load = ledger_.loads();
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
  int num_ranks_;
  LoadLedger ledger_;
  double best_ = 0;
  int num_ratings_ = 0, most_ratings_ = 0;
  std::vector<char> longest_;  ///< [num_ranks]
  std::vector<Move> found_;    ///< the best change of this round; empty if there is none
};

}  // namespace

Reassignment reassign_spaces(const SpaceLoads& loads, std::span<const int> owner, int num_ranks,
                             double threshold) {
  const double least_gain = (threshold - 1) / 2;
  Search search(loads, owner, num_ranks);
  const PredictedLoads now = search.predicted();
  double mean_s = 0;
  for (const RankLoad& rank : now.ranks) mean_s += (rank.collide_s + rank.solve_s) / num_ranks;
  if (!now.ships && now.makespan_s() <= mean_s * (1 + least_gain))
    return {{}, now.makespan_s(), now.makespan_s()};
  // Some 10 ms of root's time, as a little can be found in a later frame, too; more where a rank has much too
  // much to do.
  const double excess = now.makespan_s() / mean_s - 1;
  search.run(static_cast<int>(std::min(1e4 * std::max(1.0, excess * excess / 3), 1e6)));
  Reassignment result{{}, now.makespan_s(), search.predicted().makespan_s()};
  if (result.makespan_before_s <= result.makespan_after_s * (1 + least_gain)) return result;
  for (std::size_t space = 0; space < owner.size(); ++space) {
    if (search.owner()[space] != owner[space])
      result.moves.push_back({static_cast<int>(space), search.owner()[space]});
  }
  return result;
}

}  // namespace pbmpi::mpi
