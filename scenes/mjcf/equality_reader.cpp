#include "scenes/mjcf/equality_reader.h"

#include <algorithm>

#include "scenes/links/start.h"

namespace pbmpi::scenes::mjcf {
namespace {

using xml::Attributes;

Pose inverse(const Pose& pose) {
  const Eigen::Quaterniond back = pose.orientation.to_eigen().conjugate();
  return {back * -pose.position, Quat::from_eigen(back)};
}

}  // namespace

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
