#include "scenes/mjcf/keyframe.h"

#include <algorithm>

#include "core/error.h"
#include "core/text.h"

namespace pbmpi::scenes::mjcf {
namespace {

using links::Motion;

constexpr std::size_t most_values = 1'000'000;  // beyond any memory

std::size_t num_coordinates(Motion motion) {
  return motion == Motion::free ? 7 : motion == Motion::ball ? 4 : 1;
}

Quat unit_quat(const double* q, const xml::Attributes& key) {
  const Eigen::Quaterniond value(q[0], q[1], q[2], q[3]);
  if (!(value.norm() > 0)) key.fail("qpos", "a quaternion of 'qpos' is zero and turns nothing");
  return Quat::from_eigen(value.normalized());
}

void require_rest(xml::Attributes& key) {
  for (const char* name : {"qvel", "act"}) {
    const std::vector<double> values = key.numbers(name, 1, most_values);
    if (std::ranges::any_of(values, [](double value) { return value != 0; }))
      key.fail_unless_left_out(name, core::in_quotes(name) + " of a keyframe is not read; set it to 0");
  }
}

}  // namespace

Keyframe::Keyframe(const xml::Element& key, const xml::LeaveOut& leave_out) : attributes_(key, leave_out) {
  qpos_ = attributes_.numbers("qpos", 1, most_values);
  ctrl_ = attributes_.numbers("ctrl", 1, most_values);
  mpos_ = attributes_.numbers("mpos", 1, most_values);
  mquat_ = attributes_.numbers("mquat", 1, most_values);
  require_rest(attributes_);
  attributes_.allow({"name", "time"});
  attributes_.finish();
}

void Keyframe::place_mocap(const std::vector<int>& links, links::Mechanism& mechanism) const {
  const auto require_number = [&](const char* name, const std::vector<double>& values, std::size_t each) {
    if (!values.empty() && values.size() != each * links.size())
      attributes_.fail(name, core::in_quotes(name) + " has " + std::to_string(values.size()) +
                                 " numbers for " + std::to_string(links.size()) +
                                 " mocap bodies; give each its own");
  };
  require_number("mpos", mpos_, 3);
  require_number("mquat", mquat_, 4);
  for (std::size_t i = 0; i < links.size(); ++i) {
    Pose& pose = mechanism.links[static_cast<std::size_t>(links[i])].pose;
    if (!mpos_.empty()) pose.position = {mpos_[3 * i], mpos_[3 * i + 1], mpos_[3 * i + 2]};
    if (!mquat_.empty()) pose.orientation = unit_quat(mquat_.data() + 4 * i, attributes_);
  }
}

void Keyframe::move(const Places& places, links::Mechanism& mechanism) const {
  place_mocap(places.mocap_links, mechanism);
  if (qpos_.empty()) return;
  const std::vector<JointPlace>& joints = places.joints;
  const auto joint_at = [&](const JointPlace& at) -> links::LinkJoint& {
    return mechanism.links[static_cast<std::size_t>(at.link)].joints[static_cast<std::size_t>(at.joint)];
  };
  std::size_t wanted = 0;
  for (const JointPlace& at : joints) wanted += num_coordinates(joint_at(at).motion);
  if (qpos_.size() != wanted)
    attributes_.fail("qpos", "'qpos' has " + std::to_string(qpos_.size()) + " numbers, and the joints have " +
                                 std::to_string(wanted) + " coordinates; give each its own");
  const double* q = qpos_.data();
  for (const JointPlace& at : joints) {
    links::LinkJoint& joint = joint_at(at);
    if (joint.motion == Motion::free)
      mechanism.links[static_cast<std::size_t>(at.link)].pose = {Vec3(q[0], q[1], q[2]),
                                                                 unit_quat(q + 3, attributes_)};
    else if (joint.motion == Motion::ball)
      joint.start_turn = unit_quat(q, attributes_);
    else
      joint.start = *q - joint.reference;
    q += num_coordinates(joint.motion);
  }
}

std::vector<double> Keyframe::controls(std::size_t num_actuators, bool are_copied) const {
  if (ctrl_.empty()) return std::vector<double>(num_actuators, 0);
  if (are_copied)
    attributes_.fail_unless_left_out(
        "ctrl", "controls of actuators that <replicate> or <attach> copies are not read; write these out");
  if (ctrl_.size() != num_actuators)
    attributes_.fail("ctrl", "'ctrl' has " + std::to_string(ctrl_.size()) + " numbers for " +
                                 std::to_string(num_actuators) + " actuators; give each its own");
  return ctrl_;
}

Keyframe read_keyframe(const std::vector<const xml::Element*>& sections, const std::string& name,
                       const xml::LeaveOut& leave_out) {
  std::vector<std::string> names;
  std::string where;
  for (const xml::Element* section : sections) {
    where = section->where;
    for (const xml::Element& key : section->children) {
      names.push_back(xml::Attributes(key).text("name", ""));
      if (name.empty())
        leave_out.notes().add(key.where,
                              "the keyframe " + core::in_quotes(names.back()) +
                                  " is not the start, as in MuJoCo ('keyframe' of a TOML scene makes it so)");
      else if (names.back() == name)
        return {key, leave_out};
    }
  }
  if (name.empty()) return {};
  throw core::InputError((where.empty() ? "" : where + ": ") + "no keyframe is called " +
                         core::in_quotes(name) +
                         (names.empty() ? "; the model has none" : core::suggestion(name, names)));
}

}  // namespace pbmpi::scenes::mjcf
