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

/// May the two touch by their types and affinities? The rule is MuJoCo's ("Collision detection").
bool meet(const Kind& a, const Kind& b) {
  return (a.contype & b.conaffinity) != 0 || (b.contype & a.conaffinity) != 0;
}

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
    leader_.resize(kinds_.size());
    std::iota(leader_.begin(), leader_.end(), std::size_t{0});
    for_each_pair([&](std::size_t a, std::size_t b, bool touch) {
      if (!touch) leader_[find(a)] = find(b);
    });
  }

  ContactGroups groups(xml::Notes& notes) {
    note_what_is_parted(notes);
    std::vector<int> size(kinds_.size(), 0);
    for (std::size_t i = 0; i < kinds_.size(); ++i) ++size[find(i)];
    ContactGroups result;
    std::map<std::size_t, int> group_at;  // by leader; kinds that never need parting share two groups
    std::map<Kind, int> group_of_kind;
    const auto add = [&](bool is_static, bool self_collision) {
      result.groups.push_back({is_static, self_collision});
      return static_cast<int>(result.groups.size()) - 1;
    };
    for (std::size_t i = 0; i < kinds_.size(); ++i) {
      const bool is_static = kinds_[i].rigid == 0, is_single = size[find(i)] == 1;
      const std::size_t shared = kinds_.size() + (is_static ? 1 : 0);
      const auto [at, is_new] = group_at.try_emplace(is_single ? shared : find(i));
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
  static Kind kind_of(int rigid, const LinkGeom& geom) {
    return {rigid, geom.link, geom.contype, geom.conaffinity};
  }

  std::size_t find(std::size_t kind) {
    while (leader_[kind] != kind) kind = leader_[kind] = leader_[leader_[kind]];
    return kind;
  }

  /// Calls visit(a, b, touch) for all pairs that could touch in a Model by default.
  template <class Visit>
  void for_each_pair(Visit visit) const {
    for (std::size_t a = 0; a < kinds_.size(); ++a) {
      for (std::size_t b = a + 1; b < kinds_.size(); ++b) {
        const std::pair rigids(kinds_[a].rigid, kinds_[b].rigid);
        if (rigids.first == rigids.second || joined_.contains(rigids)) continue;
        const bool are_apart = !mechanism_.self_collision || apart_.contains(rigids) ||
                               apart_links_.contains(std::minmax(kinds_[a].link, kinds_[b].link));
        visit(a, b, !are_apart && meet(kinds_[a], kinds_[b]));
      }
    }
  }

  void note_what_is_parted(xml::Notes& notes) {
    Pairs parted;
    for_each_pair([&](std::size_t a, std::size_t b, bool touch) {
      if (touch && find(a) == find(b)) parted.insert({kinds_[a].link, kinds_[b].link});
    });
    for (const auto& [a, b] : parted) {
      const Link &first = mechanism_.links[static_cast<std::size_t>(a)],
                 &second = mechanism_.links[static_cast<std::size_t>(b)];
      notes.add(second.where, core::in_quotes(first.name) + " and " + core::in_quotes(second.name) +
                                  " do not touch either: they are kept apart from a third");
    }
  }

  const Mechanism& mechanism_;
  const RigidTree& tree_;
  Pairs apart_links_;                // of links
  Pairs apart_, joined_;             // of rigids
  std::vector<Kind> kinds_;          // sorted
  std::vector<std::size_t> leader_;  // [num_kinds] union-find
};

}  // namespace

ContactGroups contact_groups(const Mechanism& mechanism, const RigidTree& tree,
                             const std::vector<std::pair<int, int>>& apart,
                             const std::vector<std::pair<int, int>>& joined, xml::Notes& notes) {
  return Grouping(mechanism, tree, sorted(apart), sorted(joined)).groups(notes);
}

}  // namespace pbmpi::scenes::links
