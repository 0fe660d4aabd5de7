#include "app/pbreport/run/broken_joints.h"

#include <algorithm>

#include "stepping/run_event.h"

namespace pbmpi::app {
namespace {

std::vector<BrokenJoint> of_first_frames(const std::vector<BrokenJoint>& all, std::int64_t num_frames) {
  std::vector<BrokenJoint> first;
  std::copy_if(all.begin(), all.end(), std::back_inserter(first),
               [&](const BrokenJoint& one) { return one.frame < num_frames; });
  return first;
}

std::int64_t num_unknown(const io::RunData& run, const std::vector<BrokenJoint>& known) {
  const auto all = run.num_events.find(stepping::event_kind::joint_broken);
  return all == run.num_events.end() ? 0 : all->second - std::ssize(known);
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

std::vector<BrokenJoint> broken_joints(const io::RunData& run) {
  std::vector<BrokenJoint> broken;
  for (const stepping::RunEvent& event : run.events) {
    if (event.kind != stepping::event_kind::joint_broken || event.world < 0) continue;
    broken.push_back(
        {event.frame, event.step, "world " + std::to_string(event.world) + ": '" + event.name + "'"});
  }
  return broken;
}

BreakComparison compare_breaks(const io::RunData& run, const io::RunData& reference) {
  const auto num_frames =
      static_cast<std::int64_t>(std::min(run.frame_measured.size(), reference.frame_measured.size()));
  const auto all_in_run = broken_joints(run), all_in_reference = broken_joints(reference);
  const auto in_run = of_first_frames(all_in_run, num_frames);
  const auto in_reference = of_first_frames(all_in_reference, num_frames);
  BreakComparison found;
  found.in_run_only = missing_in(in_reference, in_run);
  found.in_reference_only = missing_in(in_run, in_reference);
  found.in_both = std::ssize(in_run) - std::ssize(found.in_run_only);
  found.unknown_in_run = num_unknown(run, all_in_run);
  found.unknown_in_reference = num_unknown(reference, all_in_reference);
  return found;
}

}  // namespace pbmpi::app
