#include "scenes/links/massless.h"

#include <algorithm>

#include "core/text.h"
#include "scenes/links/start.h"

namespace pbmpi::scenes::links {
namespace {

class Joining {
 public:
  Joining(RigidTree& tree, xml::Notes& notes) : tree_(tree), notes_(notes) {}

  /// From the ends inwards, so that a chain of them goes as a whole.
  void join() {
    for (std::size_t i = tree_.rigids.size() - 1; i > 0; --i) {
      const Rigid& rigid = tree_.rigids[i];
      if (rigid.mass.mass_kg > 0 || !rigid.geoms.empty()) continue;
      const std::vector<std::size_t> below = below_of(i);
      if (below.empty())
        weld(i);
      else if (below.size() == 1 && has_axes(rigid) && has_axes(tree_.rigids[below.front()]))
        pass_on(i, below.front());
    }
  }

 private:
  std::vector<std::size_t> below_of(std::size_t rigid) const {
    std::vector<std::size_t> found;
    for (std::size_t i = rigid + 1; i < tree_.rigids.size(); ++i) {
      if (tree_.rigids[i].parent == static_cast<int>(rigid)) found.push_back(i);
    }
    return found;
  }

  static bool has_axes(const Rigid& rigid) {
    return std::ranges::none_of(rigid.joints,
                                [](const LinkJoint& joint) { return joint.motion == Motion::free; });
  }

  void weld(std::size_t index) {
    const Rigid& rigid = tree_.rigids[index];
    notes_.add(rigid.where, core::in_quotes(rigid.name) +
                                " has no mass, touches nothing, and moves nothing: it is part of " +
                                core::in_quotes(tree_.rigids[static_cast<std::size_t>(rigid.parent)].name));
    remove(index, rigid.parent);
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
    remove(index, static_cast<int>(below));
  }

  static Pose relative(const Pose& outer, const Pose& inner) {
    const Eigen::Quaterniond back = outer.orientation.to_eigen().conjugate();
    return {back * (inner.position - outer.position), Quat::from_eigen(back * inner.orientation.to_eigen())};
  }

  /// Takes out a rigid whose links become those of another.
  void remove(std::size_t index, int heir) {
    const auto gone = static_cast<int>(index);
    const auto renumber = [&](int& rigid) {
      if (rigid == gone) rigid = heir;
      if (rigid > gone) --rigid;
    };
    tree_.rigids.erase(tree_.rigids.begin() + gone);
    for (Rigid& one : tree_.rigids) renumber(one.parent);
    for (int& rigid : tree_.rigid_of) renumber(rigid);
  }

  RigidTree& tree_;
  xml::Notes& notes_;
};

}  // namespace

void join_massless(RigidTree& tree, xml::Notes& notes) { Joining(tree, notes).join(); }

}  // namespace pbmpi::scenes::links
