#include "app/pbreport/run/broken_joints.h"

#include <algorithm>
#include <sstream>

#include "stepping/frame.h"

namespace pbmpi::app {
namespace {

std::vector<BrokenJoint> broken_joints(const io::RunData& run, std::int64_t num_frames) {
  std::vector<BrokenJoint> broken;
  for (const std::string& event : run.events) {
    const auto one = broken_joint(event);
    if (one && one->frame < num_frames) broken.push_back(*one);
  }
  return broken;
}

std::vector<BrokenJoint> missing_in(const std::vector<BrokenJoint>& others,
                                    const std::vector<BrokenJoint>& all) {
  std::vector<BrokenJoint> missing;
  for (const BrokenJoint& one : all) {
    if (std::none_of(others.begin(), others.end(), [&](const auto& o) { return o.joint == one.joint; }))
      missing.push_back(one);
  }
  return missing;
}

}  // namespace

std::optional<BrokenJoint> broken_joint(const std::string& event) {
  const std::string kind = ": " + std::string(stepping::joint_broken) + ": ", broke = " broke in step ";
  const std::size_t at = event.find(kind), end = event.rfind(broke);
  if (at == std::string::npos || end == std::string::npos || end < at) return std::nullopt;
  BrokenJoint found;
  const std::size_t joint = at + kind.size();
  found.joint = event.substr(joint, end - joint);
  std::string word;
  std::istringstream frame(event.substr(0, at)), step(event.substr(end + broke.size()));
  if (!(frame >> word >> found.frame) || !(step >> found.step)) return std::nullopt;
  return found;
}

BreakComparison compare_breaks(const io::RunData& run, const io::RunData& reference) {
  const auto num_frames =
      static_cast<std::int64_t>(std::min(run.frame_measured.size(), reference.frame_measured.size()));
  const auto in_run = broken_joints(run, num_frames), in_reference = broken_joints(reference, num_frames);
  BreakComparison found;
  found.in_run_only = missing_in(in_reference, in_run);
  found.in_reference_only = missing_in(in_run, in_reference);
  found.in_both = std::ssize(in_run) - std::ssize(found.in_run_only);
  return found;
}

}  // namespace pbmpi::app
