#include "solver/collide/broad_phase.h"

#include <algorithm>
#include <iterator>

#include "model/state.h"

namespace pbmpi::solver {
namespace {

using geometry::Box;
using model::GeomPair;
using model::Shape;

/// The room about a box: larger by this share of its longest side, so that pairs outlast some steps.
Box room_about(const Box& box) {
  constexpr double share = 0.05;
  double side = 0;
  for (std::size_t k = 0; k < 3; ++k) side = std::max(side, box.max[k] - box.min[k]);
  return box.grown(share * side);
}

}  // namespace

/// A box reaches below a plane if its lowest corner does.
bool BroadPhase::Plane::reaches(const Box& box) const {
  double nearest = 0;
  for (int k = 0; k < 3; ++k) {
    const auto axis = static_cast<std::size_t>(k);
    nearest += normal[k] * (normal[k] > 0 ? box.min[axis] : box.max[axis]);
  }
  return nearest <= height;
}

BroadPhase::BroadPhase(const model::Model& model, std::span<const int> geoms)
    : model_(&model),
      geoms_(geoms.begin(), geoms.end()),
      rule_(model),
      broken_(model.joints.size(), 0),
      plane_of_(geoms.size(), -1),
      rooms_(geoms.size()),
      has_moved_(geoms.size(), 0) {
  for (int i = 0; i < static_cast<int>(geoms.size()); ++i) {
    if (geom(i).shape != Shape::plane) continue;
    const model::Vec3 normal = geom(i).local.direction_to_outer(model::Vec3::UnitZ());
    plane_of_[at(i)] = static_cast<int>(planes_.size());
    planes_.push_back({i, normal, normal.dot(geom(i).local.position)});
  }
}

/// Geoms of bodies for which something has changed are looked up again.
void BroadPhase::set_broken(std::span<const std::int32_t> broken_in) {
  rule_ = model::TouchRule(*model_, broken_in);
  std::vector<char> concerned(model_->bodies.size(), 0);
  for (std::size_t i = 0; i < model_->joints.size(); ++i) {
    const model::Joint& joint = model_->joints[i];
    const char is_broken = broken_in.empty() || broken_in[i] == model::unbroken ? 0 : 1;
    if (joint.body_b == model::no_body || broken_[i] == is_broken) continue;
    broken_[i] = is_broken;
    concerned[at(joint.body_a)] = concerned[at(joint.body_b)] = 1;
  }
  for (int i = 0; i < static_cast<int>(geoms_.size()); ++i) {
    if (!is_static(i) && concerned[at(geom(i).body)] != 0) rooms_[at(i)] = {};
  }
}

void BroadPhase::append_pairs(std::span<const Box> boxes, const AwakeGeoms* awake,
                              std::vector<GeomPair>& pairs) {
  find_moved(boxes);
  if (!moved_.empty()) renew_candidates(boxes);
  for (const Candidate& candidate : candidates_) {
    if (awake != nullptr && !awake->contains(candidate.first) && !awake->contains(candidate.second)) continue;
    if (overlap(candidate, boxes))
      pairs.push_back({geoms_[at(candidate.first)], geoms_[at(candidate.second)]});
  }
}

void BroadPhase::find_moved(std::span<const Box> boxes) {
  moved_.clear();
  for (int i = 0; i < static_cast<int>(boxes.size()); ++i) {
    has_moved_[at(i)] = rooms_[at(i)].holds(boxes[at(i)]) || is_plane(i) ? 0 : 1;
    if (has_moved_[at(i)] != 0) moved_.push_back(i);
  }
}

void BroadPhase::renew_candidates(std::span<const Box> boxes) {
  for (const int moved : moved_)
    rooms_[at(moved)] = is_static(moved) ? boxes[at(moved)] : room_about(boxes[at(moved)]);
  tree_.change(moved_, rooms_);
  std::erase_if(candidates_, [this](const Candidate& candidate) {
    return has_moved_[at(candidate.first)] != 0 || has_moved_[at(candidate.second)] != 0;
  });
  found_.clear();
  for (const int moved : moved_) find_candidates_of(moved);
  std::sort(found_.begin(), found_.end());
  const auto num_kept = std::ssize(candidates_);
  candidates_.insert(candidates_.end(), found_.begin(), found_.end());
  std::inplace_merge(candidates_.begin(), candidates_.begin() + num_kept, candidates_.end());
}

/// Two that have both moved find each other once, from the first.
void BroadPhase::find_candidates_of(int moved) {
  const Box& room = rooms_[at(moved)];
  tree_.for_each_near(room, [&](int other) {
    if (other == moved || (has_moved_[at(other)] != 0 && other < moved)) return;
    add_candidate(moved, other, -1);
  });
  for (int plane = 0; !is_static(moved) && plane < static_cast<int>(planes_.size()); ++plane) {
    if (planes_[at(plane)].reaches(room)) add_candidate(moved, planes_[at(plane)].index, plane);
  }
}

void BroadPhase::add_candidate(int one, int other, int plane) {
  const auto [first, second] = std::minmax(one, other);
  if (rule_.may_touch(geoms_[at(first)], geoms_[at(second)])) found_.push_back({first, second, plane});
}

bool BroadPhase::overlap(const Candidate& candidate, std::span<const Box> boxes) const {
  if (candidate.plane < 0) return boxes[at(candidate.first)].overlaps(boxes[at(candidate.second)]);
  const int solid = is_plane(candidate.first) ? candidate.second : candidate.first;
  return planes_[at(candidate.plane)].reaches(boxes[at(solid)]);
}

}  // namespace pbmpi::solver
