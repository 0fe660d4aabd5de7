#include "scenes/mjcf/connections.h"

#include <algorithm>

#include "core/text.h"
#include "scenes/links/start.h"

namespace pbmpi::scenes::mjcf {
namespace {

using xml::Attributes;

bool meet(const links::LinkGeom& a, const links::LinkGeom& b) {
  return (a.contype & b.conaffinity) != 0 || (b.contype & a.conaffinity) != 0;
}

using xml::Attributes;

Pose inverse(const Pose& pose) {
  const Eigen::Quaterniond back = pose.orientation.to_eigen().conjugate();
  return {back * -pose.position, Quat::from_eigen(back)};
}

}  // namespace

ContactReader::ContactReader(const Places& places, links::Mechanism& mechanism)
    : mechanism_(mechanism), bodies_(places.bodies, "body"), geoms_(places.geoms, "geom") {}

void ContactReader::read(const xml::Element& element, const Part& part) {
  if (element.name == "exclude")
    read_exclude(element, part);
  else if (part.context->leave_out.drops(element.name, element.where))
    return;
  else if (element.name == "pair")
    read_pair(element, part);
  else
    xml::refuse_element(element, "unknown element; <contact> has <exclude> and <pair>; take it out");
}

void ContactReader::read_exclude(const xml::Element& element, const Part& part) {
  Attributes exclude(element, part.context->leave_out);
  for (const BodyPlace* first : bodies_.find(exclude, "body1", part)) {
    for (const BodyPlace* second : bodies_.find(exclude, "body2", part)) {
      if (are_together(*first, *second)) mechanism_.apart.emplace_back(first->link, second->link);
    }
  }
  exclude.allow({"name", "class"});
  exclude.finish();
}

void ContactReader::read_pair(const xml::Element& element, const Part& part) {
  const Context& context = *part.context;
  Attributes pair(element, context.leave_out, context.defaults.of(element, ""));
  const std::vector<double> friction = pair.numbers("friction", 1, 5);
  const int condim = pair.integer("condim", 1, 3);
  for (const GeomPlace* first : geoms_.find(pair, "geom1", part)) {
    for (const GeomPlace* second : geoms_.find(pair, "geom2", part)) {
      if (!are_together(*first, *second)) continue;
      const double own = std::max(geom_at(*first).mu, geom_at(*second).mu);
      const double wanted = condim == 1 ? 0 : friction.empty() ? own : friction[0];
      if (wanted != own)
        pair.fail_unless_left_out(friction.empty() ? "condim" : "friction",
                                  "a pair has the larger friction of its geoms; give them the pair's");
      require_free_pair(pair, first->link, second->link);
      if (context.option.collides && !meet(geom_at(*first), geom_at(*second)))
        let_touch(pair, *first, *second);
    }
  }
  for (const char* name : {"solref", "solreffriction", "solimp", "margin", "gap"}) {
    if (pair.has(name))
      context.leave_out.notes().add(pair.where(name),
                                    core::in_quotes(name) + " of pairs is left out: contacts are pbmpi's");
  }
  pair.allow({"name", "class"});
  pair.finish();
}

/// MuJoCo's pairs touch whatever else is said of them.
void ContactReader::require_free_pair(const Attributes& pair, int first, int second) const {
  const int a = moving_link(first), b = moving_link(second);
  const auto hangs_on = [&](int link, int other) {
    const int parent = mechanism_.links[static_cast<std::size_t>(link)].parent;
    return other != 0 && parent != links::no_link && moving_link(parent) == other;
  };
  if (a == b || hangs_on(a, b) || hangs_on(b, a))
    pair.fail(
        "geoms of one body, or of bodies that a joint connects, never touch here; take the pair out, or " +
        xml::LeaveOut::advice("pair"));
  const auto is_pair = [&](const std::pair<int, int>& apart) {
    return std::minmax(apart.first, apart.second) == std::minmax(first, second);
  };
  if (std::ranges::any_of(mechanism_.apart, is_pair))
    pair.fail(
        "its bodies are kept apart by an <exclude>, which counts for all of their geoms here; leave out one");
}

/// Gives the first geom a type that no geom has yet, and the second the affinity to it.
void ContactReader::let_touch(const Attributes& pair, const GeomPlace& first, const GeomPlace& second) {
  unsigned& type = types_[{first.link, first.geom}];
  if (type == 0) {
    unsigned used = 0;
    for (const links::Link& link : mechanism_.links) {
      for (const links::LinkGeom& geom : link.geoms) used |= geom.contype | geom.conaffinity;
    }
    type = ~used & (used + 1);  // the lowest bit that is 0
    if (type == 0)
      pair.fail("no type of 32 is left for the first geom of the pair; join pairs, or take types out");
    geom_at(first).contype |= type;
  }
  geom_at(second).conaffinity |= type;
}

/// The link, or the first one above it with a joint; 0, the world, without one.
int ContactReader::moving_link(int link) const {
  while (link > 0 && mechanism_.links[static_cast<std::size_t>(link)].joints.empty())
    link = mechanism_.links[static_cast<std::size_t>(link)].parent;
  return link;
}

links::LinkGeom& ContactReader::geom_at(const GeomPlace& place) {
  return mechanism_.links[static_cast<std::size_t>(place.link)].geoms[static_cast<std::size_t>(place.geom)];
}

EqualityReader::EqualityReader(const Places& places, links::Mechanism& mechanism)
    : mechanism_(mechanism),
      body_index_(places.bodies, "body"),
      joint_index_(places.joints, "joint"),
      site_index_(places.sites, "site"),
      poses_(links::poses_of(mechanism)) {
  for (const links::Link& link : mechanism.links) {
    for (const links::LinkJoint& joint : link.joints) names_.insert(joint.name);
  }
}

void EqualityReader::read(const xml::Element& element, const Part& part) {
  const Context& context = *part.context;
  Attributes equality(element, context.leave_out, context.defaults.of(element, "", "equality"));
  if (!equality.flag("active", true)) return;
  const bool is_weld = element.name == "weld";
  if (is_weld || element.name == "connect")
    read_connection(equality, is_weld, part);
  else if (element.name == "joint")
    read_joint(equality, part);
  else
    xml::refuse_element(element, "an equality of this kind has no equal; take it out");
  if (equality.has("solref") || equality.has("solimp"))
    context.leave_out.notes().add(element.where,
                                  "'solref' and 'solimp' of equalities are left out: they are rigid");
  equality.allow({"name", "class", "active", "solref", "solimp"});
  equality.finish();
}

std::vector<EqualityReader::End> EqualityReader::bodies(Attributes& equality, const std::string& key,
                                                        const Part& part) {
  std::vector<End> ends;
  for (const BodyPlace* place : body_index_.find(equality, key, part))
    ends.push_back({*place, place->link, {}});
  return ends;
}

std::vector<EqualityReader::End> EqualityReader::sites(Attributes& equality, const std::string& key,
                                                       const Part& part) {
  std::vector<End> ends;
  const Context& context = *part.context;
  for (const SitePlace* place : site_index_.find(equality, key, part)) {
    Attributes site(*place->element, context.defaults.of(*place->element, place->childclass));
    if (site.has("fromto")) site.fail("fromto", "a site with a 'fromto' connects nothing here; give 'pos'");
    ends.push_back({*place, place->link, compose(place->frame, read_pose(site, context.compiler))});
  }
  return ends;
}

/// The pose of the weld point in the first body, unless it is the one in the file.
std::optional<Pose> EqualityReader::read_relative_pose(Attributes& weld) {
  const std::vector<double> values = weld.numbers("relpose", 1, 7);
  if (values.size() < 7) return std::nullopt;
  const Eigen::Quaterniond turn(values[3], values[4], values[5], values[6]);
  if (!(turn.norm() > 0)) return std::nullopt;
  return Pose{{values[0], values[1], values[2]}, Quat::from_eigen(turn.normalized())};
}

/// Sites connect where they are; bodies connect in the places of the file.
void EqualityReader::read_connection(Attributes& equality, bool is_weld, const Part& part) {
  const Vec3 anchor = equality.vector("anchor", Vec3(Vec3::Zero()));
  const std::optional<Pose> relative = is_weld ? read_relative_pose(equality) : std::nullopt;
  const bool holds_turn = is_weld && equality.number("torquescale", xml::Range::non_negative, 1.0) > 0;
  const bool are_sites = equality.has("site1");
  std::vector<End> second{{}};  // the world
  const std::vector<End> first = are_sites ? sites(equality, "site1", part) : bodies(equality, "body1", part);
  if (are_sites)
    second = sites(equality, "site2", part);
  else if (equality.has("body2"))
    second = bodies(equality, "body2", part);
  for (End a : first) {
    for (End b : second) {
      if (!are_together(a.place, b.place)) continue;
      if (!are_sites && is_weld) {
        b.frame.position = anchor;
        a.frame = relative ? *relative : in_other(b.link, b.frame, a.link);
      } else if (!are_sites) {
        a.frame.position = anchor;
        b.frame = in_other(a.link, a.frame, b.link);
      }
      mechanism_.closures.push_back(
          {unused_name(a, b), equality.where(), holds_turn, a.link, b.link, a.frame, b.frame});
    }
  }
}

/// "torso-hand", with a number if that is taken.
std::string EqualityReader::unused_name(const End& first, const End& second) {
  const auto name_of = [&](const End& end) {
    return mechanism_.links[static_cast<std::size_t>(end.link)].name;
  };
  const std::string pair = name_of(first) + "-" + name_of(second);
  std::string name = pair;
  for (int i = 2; !names_.insert(name).second; ++i) name = pair + std::to_string(i);
  return name;
}

Pose EqualityReader::in_other(int link, const Pose& frame, int other) const {
  const Pose& from = poses_[static_cast<std::size_t>(link)];
  return compose(inverse(poses_[static_cast<std::size_t>(other)]), compose(from, frame));
}

/// A joint that no other one moves stays in its place.
void EqualityReader::read_joint(Attributes& equality, const Part& part) {
  const std::vector<double> curve = equality.numbers("polycoef", 1, 5);
  const bool follows =
      curve.size() < 2 || std::any_of(curve.begin() + 1, curve.end(), [](double c) { return c != 0; });
  if (equality.has("joint2") && follows)
    equality.fail("joint2", "a joint that follows another one has no equal; take it out, or " +
                                xml::LeaveOut::advice("joint"));
  equality.allow({"joint2"});
  const double place = curve.empty() ? 0 : curve.front();
  for (const JointPlace* at : joint_index_.find(equality, "joint1", part)) {
    links::LinkJoint& joint =
        mechanism_.links[static_cast<std::size_t>(at->link)].joints[static_cast<std::size_t>(at->joint)];
    if (joint.motion != links::Motion::hinge && joint.motion != links::Motion::slide)
      equality.fail("joint1", "an equality needs a joint of type hinge or slide");
    joint.limit = {place, place};
  }
}

}  // namespace pbmpi::scenes::mjcf
