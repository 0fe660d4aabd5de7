#include "scenes/links/massless.h"

#include <algorithm>
#include <set>
#include <utility>
#include <vector>

#include "core/text.h"
#include "scenes/links/start.h"

namespace pbmpi::scenes::links {
namespace {

class Joining {
 public:
  Joining(RigidTree& tree, xml::Notes& notes)
      : tree_(tree), notes_(notes), heir_(tree.rigids.size(), none), below_(tree.rigids.size()) {
    for (std::size_t i = 1; i < tree.rigids.size(); ++i) below_[parent_of(i)].insert(i);
  }

  /// From the ends inwards, so that a chain of them goes as a whole.
  void join() {
    for (std::size_t i = tree_.rigids.size() - 1; i > 0; --i) {
      const Rigid& rigid = tree_.rigids[i];
      if (rigid.mass.mass_kg > 0 || !rigid.geoms.empty()) continue;
      const std::set<std::size_t>& below = below_[i];
      if (below.empty())
        weld(i);
      else if (below.size() == 1 && has_axes(rigid) && has_axes(tree_.rigids[*below.begin()]))
        pass_on(i, *below.begin());
    }
    remove_joined();
  }

 private:
  static constexpr std::size_t none = static_cast<std::size_t>(-1);

  std::size_t parent_of(std::size_t rigid) const {
    return static_cast<std::size_t>(tree_.rigids[rigid].parent);
  }

  static bool has_axes(const Rigid& rigid) {
    return std::ranges::none_of(rigid.joints,
                                [](const LinkJoint& joint) { return joint.motion == Motion::free; });
  }

  void weld(std::size_t index) {
    const Rigid& rigid = tree_.rigids[index];
    notes_.add(rigid.where, core::in_quotes(rigid.name) +
                                " has no mass, touches nothing, and moves nothing: it is part of " +
                                core::in_quotes(tree_.rigids[parent_of(index)].name));
    heir_[index] = parent_of(index);
    below_[parent_of(index)].erase(index);
  }

  void pass_on(std::size_t index, std::size_t below) {
    const Rigid& rigid = tree_.rigids[index];
    Rigid& heir = tree_.rigids[below];
    notes_.add(rigid.where, core::in_quotes(rigid.name) + " has no mass: its joints become joints of " +
                                core::in_quotes(heir.name));
    std::vector<LinkJoint> joints = rigid.joints;
    const Pose heir_in_rigid = relative(rigid.pose, heir.pose);
    for (LinkJoint& joint : joints) describe_from(heir_in_rigid, joint);
    heir.joints.insert(heir.joints.begin(), joints.begin(), joints.end());
    heir.parent = rigid.parent;
    heir_[index] = below;
    below_[parent_of(index)].erase(index);
    below_[parent_of(index)].insert(below);
  }

  static Pose relative(const Pose& outer, const Pose& inner) {
    const Eigen::Quaterniond back = outer.orientation.to_eigen().conjugate();
    return {back * (inner.position - outer.position), Quat::from_eigen(back * inner.orientation.to_eigen())};
  }

  /// Takes out the rigids whose links become those of others. The heir of a rigid is its parent, whose own
  /// heir is known by then, or one that stays.
  void remove_joined() {
    std::vector<int> index(tree_.rigids.size());
    std::size_t kept = 0;
    for (std::size_t i = 0; i < index.size(); ++i) {
      if (heir_[i] != none) continue;
      index[i] = static_cast<int>(kept);
      if (kept != i) tree_.rigids[kept] = std::move(tree_.rigids[i]);
      ++kept;
    }
    for (std::size_t i = 0; i < index.size(); ++i) {
      if (heir_[i] != none) index[i] = index[heir_[i]];
    }
    tree_.rigids.erase(tree_.rigids.begin() + static_cast<std::ptrdiff_t>(kept), tree_.rigids.end());
    for (Rigid& one : tree_.rigids) {
      if (one.parent != no_link) one.parent = index[static_cast<std::size_t>(one.parent)];
    }
    for (int& rigid : tree_.rigid_of) rigid = index[static_cast<std::size_t>(rigid)];
  }

  RigidTree& tree_;
  xml::Notes& notes_;
  std::vector<std::size_t> heir_;             // [num_rigids] none: stays
  std::vector<std::set<std::size_t>> below_;  // [num_rigids] those whose parent it is
};

}  // namespace

void join_massless(RigidTree& tree, xml::Notes& notes) { Joining(tree, notes).join(); }

}  // namespace pbmpi::scenes::links
