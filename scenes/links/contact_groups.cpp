#include "scenes/links/contact_groups.h"

#include <algorithm>
#include <map>
#include <numeric>
#include <set>

#include "core/text.h"

namespace pbmpi::scenes::links {
namespace {

using Pairs = std::set<std::pair<int, int>>;

Pairs sorted(const std::vector<std::pair<int, int>>& pairs) {
  Pairs result;
  for (const auto& [a, b] : pairs) result.insert(std::minmax(a, b));
  return result;
}

/// The geoms of one link with the same type and affinity.
struct Kind {
  int rigid, link;
  unsigned contype, conaffinity;
  auto operator<=>(const Kind&) const = default;
};

class Grouping {
 public:
  Grouping(const Mechanism& mechanism, const RigidTree& tree, Pairs apart, Pairs joined)
      : mechanism_(mechanism),
        tree_(tree),
        apart_links_(sorted(mechanism.apart)),
        apart_(std::move(apart)),
        joined_(std::move(joined)) {
    for (std::size_t rigid = 0; rigid < tree.rigids.size(); ++rigid) {
      for (const LinkGeom& geom : tree.rigids[rigid].geoms) {
        if (geom.contype != 0 || geom.conaffinity != 0)
          kinds_.push_back(kind_of(static_cast<int>(rigid), geom));
      }
    }
    std::ranges::sort(kinds_);
    kinds_.erase(std::unique(kinds_.begin(), kinds_.end()), kinds_.end());
    for (std::size_t kind = 0; kind < kinds_.size(); ++kind) alone_[masks_of(kind)].insert(kind);
    find_neighbours();
    leader_.resize(kinds_.size(), kinds_.size());
    for (std::size_t kind = 0; kind < kinds_.size(); ++kind) {
      if (leader_[kind] == kinds_.size()) gather_from(kind);
    }
  }

  ContactGroups groups(xml::Notes& notes) {
    note_what_is_parted(notes);
    std::vector<int> size(kinds_.size(), 0);
    for (const std::size_t leader : leader_) ++size[leader];
    ContactGroups result;
    std::map<std::size_t, int> group_at;  // by leader; kinds that never need parting share two groups
    std::map<Kind, int> group_of_kind;
    const auto add = [&](bool is_static, bool self_collision) {
      result.groups.push_back({is_static, self_collision});
      return static_cast<int>(result.groups.size()) - 1;
    };
    for (std::size_t i = 0; i < kinds_.size(); ++i) {
      const bool is_static = kinds_[i].rigid == 0, is_single = size[leader_[i]] == 1;
      const std::size_t shared = kinds_.size() + (is_static ? 1 : 0);
      const auto [at, is_new] = group_at.try_emplace(is_single ? shared : leader_[i]);
      if (is_new) at->second = add(is_static, is_single && !is_static);
      auto& group = result.groups[static_cast<std::size_t>(at->second)];
      group.is_static = group.is_static && is_static;
      group_of_kind[kinds_[i]] = at->second;
    }
    for (std::size_t rigid = 0; rigid < tree_.rigids.size(); ++rigid) {
      auto& of_geoms = result.group_of.emplace_back();
      for (const LinkGeom& geom : tree_.rigids[rigid].geoms) {
        const auto found = group_of_kind.find(kind_of(static_cast<int>(rigid), geom));
        of_geoms.push_back(found == group_of_kind.end() ? -1 : found->second);
      }
    }
    return result;
  }

 private:
  /// Type and affinity. A model has few different ones.
  using Masks = std::pair<unsigned, unsigned>;
  using KindSets = std::map<Masks, std::set<std::size_t>>;

  static Kind kind_of(int rigid, const LinkGeom& geom) {
    return {rigid, geom.link, geom.contype, geom.conaffinity};
  }
  Masks masks_of(std::size_t kind) const { return {kinds_[kind].contype, kinds_[kind].conaffinity}; }

  /// May the two touch by their types and affinities? The rule is MuJoCo's ("Collision detection").
  bool meet(const Masks& a, const Masks& b) const {
    return mechanism_.self_collision && ((a.first & b.second) != 0 || (b.first & a.second) != 0);
  }

  /// Does a Model keep the two from touching by itself?
  bool never_touch(std::size_t a, std::size_t b) const {
    const auto rigids = std::minmax(kinds_[a].rigid, kinds_[b].rigid);
    return rigids.first == rigids.second || joined_.contains(rigids);
  }

  bool are_apart(std::size_t a, std::size_t b) const {
    return apart_.contains(std::minmax(kinds_[a].rigid, kinds_[b].rigid)) ||
           apart_links_.contains(std::minmax(kinds_[a].link, kinds_[b].link));
  }

  /// Finds the kinds that are kept apart whatever their types and affinities are.
  void find_neighbours() {
    apart_of_.resize(kinds_.size());
    const auto add_all = [&](const Pairs& pairs, const auto& member) {
      std::map<int, std::vector<std::size_t>> kinds;
      for (std::size_t kind = 0; kind < kinds_.size(); ++kind) kinds[kinds_[kind].*member].push_back(kind);
      for (const auto& [first, second] : pairs) {
        for (const std::size_t a : kinds[first]) {
          for (const std::size_t b : kinds[second]) {
            apart_of_[a].push_back(b);
            apart_of_[b].push_back(a);
          }
        }
      }
    };
    add_all(apart_, &Kind::rigid);
    add_all(apart_links_, &Kind::link);
  }

  /// Gives a leader to all kinds that must not touch it, or one of these. Each kind leaves alone_ once, and
  /// one that stays there, although it does not meet the other, has a part or a joint with it: the time
  /// grows with kinds, joints and pairs apart.
  void gather_from(std::size_t leader) {
    std::vector<std::size_t> gathered;
    const auto gather = [&](std::size_t kind) {
      leader_[kind] = leader;
      gathered.push_back(kind);
    };
    gather(leader);
    alone_[masks_of(leader)].erase(leader);
    while (!gathered.empty()) {
      const std::size_t kind = gathered.back();
      gathered.pop_back();
      for (const std::size_t other : apart_of_[kind]) {
        if (!never_touch(kind, other) && alone_[masks_of(other)].erase(other) > 0) gather(other);
      }
      for (auto& [masks, others] : alone_) {
        if (meet(masks_of(kind), masks)) continue;
        for (auto other = others.begin(); other != others.end();) {
          if (never_touch(kind, *other)) {
            ++other;
          } else {
            gather(*other);
            other = others.erase(other);
          }
        }
      }
    }
  }

  /// Notes of each link the first that it could touch but for their group.
  void note_what_is_parted(xml::Notes& notes) const {
    std::map<std::size_t, KindSets> kinds_of_leader;
    std::map<int, std::set<int>> parted;  // links, most_named at most
    for (std::size_t kind = 0; kind < kinds_.size(); ++kind) {
      KindSets& before = kinds_of_leader[leader_[kind]];
      std::set<int>& links = parted[kinds_[kind].link];
      for (const auto& [masks, others] : before) {
        if (!meet(masks_of(kind), masks)) continue;
        for (auto other = others.begin(); other != others.end() && links.size() < most_named; ++other) {
          if (!never_touch(kind, *other) && !are_apart(kind, *other)) links.insert(kinds_[*other].link);
        }
      }
      before[masks_of(kind)].insert(kind);
    }
    for (const auto& [link, others] : parted) {
      if (!others.empty()) note_parted(others, link, notes);
    }
  }

  void note_parted(const std::set<int>& links, int link, xml::Notes& notes) const {
    const auto name = [&](int index) {
      return core::in_quotes(mechanism_.links[static_cast<std::size_t>(index)].name);
    };
    const std::string others = links.size() < most_named ? "" : ", nor do others and " + name(link);
    notes.add(mechanism_.links[static_cast<std::size_t>(link)].where,
              name(*links.begin()) + " and " + name(link) + " do not touch either" + others +
                  ": they are kept apart from a third");
  }

  /// Kinds that are looked for before a note says that there are others.
  static constexpr std::size_t most_named = 2;

  const Mechanism& mechanism_;
  const RigidTree& tree_;
  Pairs apart_links_;                               // of links
  Pairs apart_, joined_;                            // of rigids
  std::vector<Kind> kinds_;                         // sorted
  std::vector<std::vector<std::size_t>> apart_of_;  // [num_kinds]
  KindSets alone_;                                  // kinds without a leader
  std::vector<std::size_t> leader_;                 // [num_kinds] the first kind of its group
};

}  // namespace

ContactGroups contact_groups(const Mechanism& mechanism, const RigidTree& tree,
                             const std::vector<std::pair<int, int>>& apart,
                             const std::vector<std::pair<int, int>>& joined, xml::Notes& notes) {
  return Grouping(mechanism, tree, sorted(apart), sorted(joined)).groups(notes);
}

}  // namespace pbmpi::scenes::links
