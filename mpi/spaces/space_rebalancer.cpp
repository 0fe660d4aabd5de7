#include "mpi/spaces/space_rebalancer.h"

#include <algorithm>
#include <cstddef>
#include <map>
#include <numeric>
#include <span>
#include <vector>

#include "core/clock.h"
#include "effects/field_of_interest.h"
#include "geometry/box_tree.h"
#include "mpi/spaces/plan/load_ledger.h"
#include "mpi/spaces/plan/space_loads.h"
#include "mpi/spaces/plan/space_ownership.h"
#include "mpi/spaces/step/frame_report.h"
#include "stepping/space_stepper.h"

namespace pbmpi::mpi {
namespace {

using core::Phase;

/// The measurements of a frame, and what they were measured on.
struct MeasuredFrame {
  const stepping::SpaceStepper* stepper = nullptr;  ///< gives the map of spaces and the lanes
  const effects::FieldOfInterest* field = nullptr;  ///< null without one
  const SpaceOwnership* ownership = nullptr;        ///< the ownership during the frame
  const FrameFindings* findings = nullptr;          ///< findings of its last step
  std::span<const geometry::Box> boxes;             ///< [num_spaces] at its end
  std::span<const core::PhaseTimes> times;          ///< [num_ranks] seconds a frame by phase
  int steps_per_frame = 1;
};

/// Weights of a frame's work, before they are scaled to seconds.
struct Weights {
  SpaceLoads loads;               ///< collide_s is empty, root_extra_s and ship_s are 0
  std::vector<double> collision;  ///< [num_spaces] contact rows and bodies
};

/// Adds islands of one space to SpaceLoads::inside, and others to SpaceLoads::islands.
void add_islands(const std::map<int, std::map<int, SpacePart>>& islands, SpaceLoads& loads) {
  for (const auto& [island, parts] : islands) {
    if (parts.size() == 1) {
      loads.inside[parts.begin()->first].add(parts.begin()->second.work);
      continue;
    }
    std::vector<SpacePart>& shared = loads.islands.emplace_back();
    for (const auto& [space, part] : parts) shared.push_back(part);
  }
}

Weights weigh(const MeasuredFrame& frame) {
  const FrameFindings& found = *frame.findings;
  const model::SpaceMap& map = frame.stepper->map();
  const auto num_spaces = static_cast<std::size_t>(map.num_spaces());
  const auto num_shapes = static_cast<std::size_t>(map.num_shapes());
  // Units of a shape that get few iterations are solved apart from the others, so they count as another
  // shape.
  const std::size_t num_sorts = frame.field == nullptr ? 1 : 2;
  Weights weights{{}, std::vector<double>(num_spaces, 0)};
  SpaceLoads& loads = weights.loads;
  loads.num_lanes = frame.stepper->num_lanes();
  loads.batch_s.assign(num_sorts * num_shapes, 0);
  loads.inside.assign(num_spaces, {std::vector<int>(num_sorts * num_shapes, 0), 0, 0});
  std::map<int, std::map<int, SpacePart>> islands;  // by island and space
  for (int unit = 0; unit < map.num_units(); ++unit) {
    const int space = map.space_of_unit[unit];
    const auto bodies = static_cast<int>(map.bodies_of_unit[unit].size());
    const double contact_rows = found.weight[unit] - map.rows_of_unit[unit] - bodies;
    const bool inside = frame.field == nullptr || found.near[unit];
    const double share = inside ? 1 : frame.field->outside_share();
    const std::size_t shape = map.shape_of_unit[unit] + (inside ? 0 : num_shapes);
    loads.batch_s[shape] = share * loads.num_lanes * (map.rows_of_unit[unit] + bodies);
    SpacePart& part = islands[found.island[unit]][space];
    part.space = space;
    part.work.units.resize(loads.batch_s.size());
    ++part.work.units[shape];
    part.work.contacts_s += share * contact_rows;
    part.work.bodies += bodies;
    weights.collision[space] += contact_rows + bodies;
  }
  add_islands(islands, loads);
  return weights;
}

/// [num_spaces] seconds of collision.
std::vector<double> collision_seconds(const MeasuredFrame& frame, std::span<const double> weight) {
  const std::vector<int>& owner = frame.ownership->owner;
  std::vector<double> rank_weight(frame.times.size(), 0), seconds;
  for (std::size_t space = 0; space < owner.size(); ++space) rank_weight[owner[space]] += weight[space];
  for (std::size_t space = 0; space < owner.size(); ++space) {
    const core::PhaseTimes& times = frame.times[owner[space]];
    const double rank_s = times[Phase::collide] + times[Phase::islands];
    seconds.push_back(rank_weight[owner[space]] > 0 ? rank_s * weight[space] / rank_weight[owner[space]] : 0);
  }
  return seconds;
}

double solver_seconds(const core::PhaseTimes& times) {
  return times[Phase::rows] + times[Phase::solve] + times[Phase::integrate];
}

/// [num_ranks] the work of each rank's solver, from `loads` in weights, and how long it took.
std::vector<RankSample> samples_of(const SpaceLoads& loads, const MeasuredFrame& frame) {
  const auto num_ranks = static_cast<int>(frame.times.size());
  SpaceLoads no_contacts = loads, no_batches = loads;
  no_contacts.scale({1, 0});
  no_batches.scale({0, 1});
  const PredictedLoads batches = predict_loads(no_contacts, frame.ownership->owner, num_ranks);
  const PredictedLoads contacts = predict_loads(no_batches, frame.ownership->owner, num_ranks);
  std::vector<RankSample> samples;
  for (std::size_t rank = 0; rank < frame.times.size(); ++rank)
    samples.push_back(
        {batches.ranks[rank].solve_s, contacts.ranks[rank].solve_s, solver_seconds(frame.times[rank])});
  return samples;
}

/// Overlapping boxes are near each other now; boxes that do so once each has grown by half of its longest
/// side may soon be.
geometry::Box with_surroundings(const geometry::Box& box) {
  double longest = 0;
  for (std::size_t k = 0; k < 3; ++k) longest = std::max(longest, box.max[k] - box.min[k]);
  return box.grown(longest / 2);
}

/// [boxes] the others that each one overlaps.
std::vector<std::vector<int>> overlapping(std::span<const geometry::Box> boxes) {
  std::vector<std::vector<int>> others(boxes.size());
  geometry::BoxTree tree;
  tree.set(boxes);
  for (int box = 0; box < std::ssize(boxes); ++box) {
    tree.for_each_near(boxes[box], [&](int other) {
      if (other != box) others[box].push_back(other);
    });
  }
  return others;
}

/// Splits root's section into what it does in any case, and what the bodies near other ranks' spaces cost it.
void split_root_section(const MeasuredFrame& frame, SpaceLoads& loads) {
  const std::vector<int>& owner = frame.ownership->owner;
  const model::SpaceMap& map = frame.stepper->map();
  std::vector<geometry::Box> grown;
  for (const geometry::Box& box : frame.boxes) grown.push_back(with_surroundings(box));
  const std::vector<std::vector<int>> now = overlapping(frame.boxes), soon = overlapping(grown);
  int num_bodies = 0, num_near = 0;
  for (std::size_t space = 0; space < owner.size(); ++space) {
    SpaceBorder& border = loads.borders.emplace_back();
    border.neighbours = soon[space];
    for (const int unit : map.units_of_space[space])
      border.bodies += static_cast<int>(map.bodies_of_unit[unit].size());
    num_bodies += border.bodies;
    if (is_near_others(now[space], owner, static_cast<int>(space))) num_near += border.bodies;
  }
  const double section_s = frame.times.front()[Phase::cross_space];
  if (num_near > 0) {
    loads.cross_s = section_s / num_near;
  } else if (num_bodies > 0) {
    // Not measured: as if root collided them once more, which keeps neighbours together where that is free.
    loads.root_extra_s = section_s;
    loads.cross_s = std::accumulate(loads.collide_s.begin(), loads.collide_s.end(), 0.0) / num_bodies;
  }
}

/// Splits the ranks' seconds. Seconds of collision go to the spaces of the rank that spent them, by contact
/// rows and bodies. Seconds of the solver go to batches of equal units and to contacts, by their rows, over
/// all ranks (an island costs the same anywhere).
SpaceLoads measure_loads(const MeasuredFrame& frame) {
  auto [loads, collision] = weigh(frame);
  loads.collide_s = collision_seconds(frame, collision);
  loads.scale(fit_costs(samples_of(loads, frame)));
  split_root_section(frame, loads);
  double ship_s = 0;
  for (const core::PhaseTimes& rank : frame.times) ship_s += rank[Phase::ship];
  if (frame.findings->bodies_shipped > 0)
    loads.ship_s =
        frame.steps_per_frame * ship_s / (2.0 * static_cast<double>(frame.findings->bodies_shipped));
  return loads;
}

}  // namespace

void SpaceRebalancer::note_times(const FrameFindings& findings) {
  if (last_times_.size() == window) last_times_.erase(last_times_.begin());
  last_times_.push_back(findings.times);
}

std::vector<core::PhaseTimes> SpaceRebalancer::least_times() const {
  std::vector<core::PhaseTimes> least = last_times_.front();
  for (const std::vector<core::PhaseTimes>& frame : last_times_) {
    for (std::size_t rank = 0; rank < least.size(); ++rank) {
      for (std::size_t phase = 0; phase < core::num_phases; ++phase)
        least[rank].seconds[phase] = std::min(least[rank].seconds[phase], frame[rank].seconds[phase]);
    }
  }
  return least;
}

Reassignment SpaceRebalancer::decide(const FrameFindings& findings, const SpaceOwnership& ownership,
                                     std::span<const geometry::Box> boxes, bool may_move) {
  frames_until_decision_ = std::max(0, frames_until_decision_ - 1);
  if (!may_move || frames_until_decision_ > 0) return {};
  frames_until_decision_ = frames_between_decisions + 1;
  const std::vector<core::PhaseTimes> times = least_times();
  const SpaceLoads loads =
      measure_loads({stepper_, stepper_->field(), &ownership, &findings, boxes, times, steps_per_frame_});
  return reassign_spaces(loads, ownership.owner, static_cast<int>(ownership.spaces.size()), threshold_);
}

}  // namespace pbmpi::mpi
