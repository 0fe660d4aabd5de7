#include "scenes/links/assembly.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>

#include "core/error.h"
#include "core/text.h"
#include "scenes/links/drive.h"
#include "scenes/links/start.h"

namespace pbmpi::scenes::links {
namespace {

void refuse_double_names(const Mechanism& mechanism) {
  std::set<std::string> links, joints;
  for (const Link& link : mechanism.links) {
    core::require_input(links.insert(link.name).second,
                        link.where + ": a second body " + core::in_quotes(link.name) + "; rename one");
    for (const LinkJoint& joint : link.joints) {
      core::require_input(joints.insert(joint.name).second,
                          joint.where + ": a second joint " + core::in_quotes(joint.name) + "; rename one");
    }
  }
  for (const Closure& closure : mechanism.closures)
    core::require_input(joints.insert(closure.name).second,
                        closure.where + ": a second joint " + core::in_quotes(closure.name) + "; rename one");
}

/// Does a single joint of the Model connect the body to its parent?
bool is_joined(const JointChain& chain) { return chain.pieces.size() == 1 || chain.is_gimbal; }

/// The friction that all geoms of a group share; NaN where they differ, with a note.
std::vector<double> frictions(const RigidTree& tree, const ContactGroups& groups, xml::Notes& notes) {
  constexpr double unknown = -1;
  std::vector<double> mu(groups.groups.size(), unknown);
  for (std::size_t rigid = 0; rigid < tree.rigids.size(); ++rigid) {
    for (std::size_t i = 0; i < tree.rigids[rigid].geoms.size(); ++i) {
      const int group = groups.group_of[rigid][i];
      if (group < 0) continue;
      double& own = mu[static_cast<std::size_t>(group)];
      const LinkGeom& geom = tree.rigids[rigid].geoms[i];
      if (own == unknown) own = geom.mu;
      if (own == geom.mu || std::isnan(own)) continue;
      own = std::numeric_limits<double>::quiet_NaN();
      notes.add(geom.where,
                "geoms of unequal friction: a pair has the geometric mean of the two, not the larger");
    }
  }
  return mu;
}

/// "1 + 2"
std::string name_of(const ChainPiece& piece) {
  std::string name;
  for (const LinkJoint& joint : piece.joints) name += (name.empty() ? "" : "+") + joint.name;
  return name;
}

/// The motors of a piece, with their notes.
std::vector<model::AxisMotor> motors_of(const ChainPiece& piece, double dt_s, xml::Notes& notes) {
  std::vector<model::AxisMotor> motors;
  for (const LinkJoint& joint : piece.joints)
    motors.push_back(motor_of(joint.drive, dt_s, joint.where, notes));
  return motors;
}

void note_joint(const LinkJoint& joint, xml::Notes& notes) {
  constexpr double rounding = 1e-6;  // [rad] or [m] of a user's digits
  if (joint.limit.low > rounding || joint.limit.high < -rounding)
    notes.add(joint.where,
              "the joint starts outside of its limits, which push it back ('joints' of a TOML scene "
              "gives it another start)");
}

}  // namespace

Assembly::Assembly(const Mechanism& mechanism, double dt_s, xml::Notes& notes)
    : tree_(merge(at_start(mechanism), notes)), dt_s_(dt_s) {
  refuse_double_names(mechanism);
  std::vector<std::pair<int, int>> apart, joined;
  for (std::size_t i = 0; i < tree_.rigids.size(); ++i) {
    const Rigid& rigid = tree_.rigids[i];
    chains_.push_back(chain_of(rigid));
    const JointChain& chain = chains_.back();
    if (rigid.parent > 0 && !chain.pieces.empty())
      (is_joined(chain) ? joined : apart).emplace_back(rigid.parent, static_cast<int>(i));
  }
  take_closures(mechanism, notes);
  for (const Closure& closure : closures_) {
    if (closure.link > 0 && closure.other > 0) joined.emplace_back(closure.link, closure.other);
  }
  groups_ = contact_groups(mechanism, tree_, apart, joined, notes);
  mu_of_group_ = frictions(tree_, groups_, notes);
  note_chains(notes);
}

/// Two rigids of which one hangs on the world by no joint need no closure. A weld holds the two where they
/// start.
void Assembly::take_closures(const Mechanism& mechanism, xml::Notes& notes) {
  if (mechanism.closures.empty()) return;
  constexpr double rounding = 1e-6;  // [m], and of a quaternion, of a user's digits
  const std::vector<Pose> poses = poses_of(at_start(mechanism));
  for (const Closure& given : mechanism.closures) {
    const auto link = static_cast<std::size_t>(given.link), other = static_cast<std::size_t>(given.other);
    Closure closure = given;
    closure.link = tree_.rigid_of[link];
    closure.other = tree_.rigid_of[other];
    closure.in_link = compose(poses[link], given.in_link);
    closure.in_other = compose(poses[other], given.in_other);
    if (closure.link == closure.other) {
      notes.add(given.where, "what it connects is one body: it is left out");
      continue;
    }
    const Eigen::Quaterniond turn =
        closure.in_link.orientation.to_eigen().conjugate() * closure.in_other.orientation.to_eigen();
    const bool is_apart = (closure.in_link.position - closure.in_other.position).norm() > rounding;
    core::require_input(!given.holds_turn || (!is_apart && turn.vec().norm() <= rounding),
                        given.where +
                            ": a weld holds bodies where they start, and these are to move together "
                            "first; place them so");
    if (is_apart) notes.add(given.where, "the points that it connects start apart, and are pulled together");
    closures_.push_back(std::move(closure));
  }
}

void Assembly::note_chains(xml::Notes& notes) const {
  for (const JointChain& chain : chains_) {
    for (const ChainPiece& piece : chain.pieces) {
      motors_of(piece, dt_s_, notes);
      for (const LinkJoint& joint : piece.joints) note_joint(joint, notes);
    }
    if (chain.pieces.size() > 1)
      notes.add(
          chain.pieces.front().joints.front().where,
          "several joints of one body that are no universal joint: light bodies stand between them, with 2 % "
          "of its mass each");
  }
}

/// Puts one mechanism into one model.
class Assembly::Builder {
 public:
  Builder(const Assembly& assembly, const Place& place, model::Model& model)
      : assembly_(assembly), place_(place), model_(model) {}

  void build() {
    add_actors();
    const std::vector<Rigid>& rigids = assembly_.tree_.rigids;
    add_geoms(0, model::no_body, place_.pose);
    bodies_.push_back(model::no_body);
    for (std::size_t i = 1; i < rigids.size(); ++i) add_link(i);
    for (std::size_t i = 1; i < rigids.size(); ++i) add_chain(i);
    for (const Closure& closure : assembly_.closures_) add_closure(closure);
  }

 private:
  std::string named(const std::string& name) const { return place_.name + "." + name; }
  Pose frame_of(std::size_t rigid) const { return compose(place_.pose, assembly_.tree_.rigids[rigid].pose); }

  /// The group in which bodies touch each other has the mechanism's name alone.
  void add_actors() {
    first_actor_ = static_cast<int>(model_.actors.size());
    int parted = 0;
    for (const ContactGroup& group : assembly_.groups_.groups) {
      const bool is_parted = !group.is_static && !group.self_collision;
      const std::string name = group.is_static ? named("world")
                               : is_parted     ? named("apart" + std::to_string(++parted))
                                               : place_.name;
      const auto kind = group.is_static ? model::ActorKind::ground : model::ActorKind::prop;
      model_.actors[static_cast<std::size_t>(add_actor(model_, name, kind))].self_collision =
          group.self_collision;
    }
    add_frictions();
    if (assembly_.groups_.groups.empty()) add_actor(model_, place_.name, model::ActorKind::prop);
  }

  /// A pair of MuJoCo's geoms has the larger friction of the two, not the geometric mean.
  void add_frictions() {
    const std::vector<double>& mu = assembly_.mu_of_group_;
    for (std::size_t a = 0; a < mu.size(); ++a) {
      for (std::size_t b = a + 1; b < mu.size(); ++b) {
        if (std::isnan(mu[a]) || std::isnan(mu[b]) || mu[a] == mu[b]) continue;
        model_.pair_materials.push_back({first_actor_ + static_cast<int>(a),
                                         first_actor_ + static_cast<int>(b),
                                         {std::max(mu[a], mu[b]), 0}});
      }
    }
  }

  /// The actor of a body's first geom that can touch anything, to which most of the body's geoms belong.
  int actor_of(std::size_t rigid) const {
    for (const int group : assembly_.groups_.group_of[rigid]) {
      if (group >= 0) return first_actor_ + group;
    }
    const auto& groups = assembly_.groups_.groups;
    const auto moving = std::ranges::find(groups, false, &ContactGroup::is_static);
    return first_actor_ + (moving == groups.end() ? 0 : static_cast<int>(moving - groups.begin()));
  }

  int add_one(const std::string& name, std::size_t rigid, const MassProperties& mass) {
    const Pose frame = frame_of(rigid);
    model::Body body;
    body.name = named(name);
    body.actor = actor_of(rigid);
    body.mass_kg = mass.mass_kg;
    body.inertia = (mass.inertia + mass.inertia.transpose()) / 2;
    body.pose = {frame.point_to_outer(mass.centre), frame.orientation};
    body.velocity = place_.velocity;
    return add_body(model_, std::move(body));
  }

  void add_link(std::size_t rigid) {
    const MassProperties& mass = assembly_.chains_[rigid].rest;
    bodies_.push_back(add_one(assembly_.tree_.rigids[rigid].name, rigid, mass));
    add_geoms(rigid, bodies_.back(), {-mass.centre, {}});
  }

  /// `frame`: the rigid's frame in the body's frame, or in the world.
  void add_geoms(std::size_t rigid, int body, const Pose& frame) {
    const std::vector<LinkGeom>& geoms = assembly_.tree_.rigids[rigid].geoms;
    for (std::size_t i = 0; i < geoms.size(); ++i) {
      const int group = assembly_.groups_.group_of[rigid][i];
      if (group < 0) continue;
      model_.geoms.push_back({body,
                              first_actor_ + group,
                              place_.space,
                              geoms[i].shape,
                              geoms[i].size,
                              compose(frame, geoms[i].pose),
                              {geoms[i].mu, 0},
                              geoms[i].hull,
                              geoms[i].mesh});
    }
  }

  void add_chain(std::size_t index) {
    const Rigid& rigid = assembly_.tree_.rigids[index];
    const JointChain& chain = assembly_.chains_[index];
    const int parent = bodies_[static_cast<std::size_t>(rigid.parent)];
    int upper = parent;
    for (std::size_t i = 0; i < chain.pieces.size(); ++i) {
      const bool is_last = i == chain.between.size();
      const int lower = is_last ? bodies_[index]
                                : add_one(rigid.name + "." + std::to_string(i + 1), index, chain.between[i]);
      add_joint(chain.pieces[i], frame_of(index), lower, upper);
      upper = lower;
    }
    if (chain.is_gimbal && parent != model::no_body) {
      const Vec3 anchor = frame_of(index).point_to_outer(rigid.joints.front().anchor);
      model_.joints.push_back(
          join(model_, named(rigid.name + ".ball"), model::JointKind::ball, bodies_[index], parent, anchor));
    }
  }

  /// An angle measures the lower body's turn against the upper one, as ODE does for its first body. A
  /// universal's first axis is fixed in its first body, as is that of the link's second joint.
  void add_joint(const ChainPiece& piece, const Pose& frame, int lower, int upper) {
    const LinkJoint &outer = piece.joints.front(), &inner = piece.joints.back();
    const Vec3 axis1 = frame.direction_to_outer(inner.axis), axis2 = frame.direction_to_outer(outer.axis);
    const bool has_two = piece.joints.size() == 2;
    model::Joint joint = join(model_, named(name_of(piece)), piece.kind, lower, upper,
                              frame.point_to_outer(inner.anchor), axis1, has_two ? axis2 : Vec3::UnitX());
    xml::Notes told_before;
    const std::vector<model::AxisMotor> motors = motors_of(piece, assembly_.dt_s_, told_before);
    joint.limits[0] = inner.limit;
    joint.motors[0] = motors.back();
    joint.armature[0] = inner.armature;
    if (has_two) {
      joint.limits[1] = outer.limit;
      joint.motors[1] = motors.front();
      joint.armature[1] = outer.armature;
    }
    model_.joints.push_back(std::move(joint));
  }

  /// The first body of a joint moves.
  void add_closure(const Closure& closure) {
    const bool is_turned = closure.link == 0;
    const int a = bodies_[static_cast<std::size_t>(is_turned ? closure.other : closure.link)];
    const int b = bodies_[static_cast<std::size_t>(is_turned ? closure.link : closure.other)];
    const auto at = [&](const Pose& frame) { return place_.pose.point_to_outer(frame.position); };
    const Vec3 on_a = at(is_turned ? closure.in_other : closure.in_link),
               on_b = at(is_turned ? closure.in_link : closure.in_other);
    const auto kind = closure.holds_turn ? model::JointKind::fixed : model::JointKind::ball;
    model::Joint joint = join(model_, named(closure.name), kind, a, b, on_a);
    if (on_a != on_b) joint.anchor_b = join(model_, "", kind, a, b, on_b).anchor_b;
    model_.joints.push_back(std::move(joint));
  }

  const Assembly& assembly_;
  const Place& place_;
  model::Model& model_;
  int first_actor_ = 0;
  std::vector<int> bodies_;  // [num_rigids]
};

void Assembly::put_into(const Place& place, model::Model& model) const {
  Builder(*this, place, model).build();
}

}  // namespace pbmpi::scenes::links
