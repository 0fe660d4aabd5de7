#include "io/join/join_plan.h"

#include <algorithm>

#include "core/error.h"

namespace pbmpi::io {
namespace {

std::string frames_text(std::int64_t first, std::int64_t last) {
  if (first == last) return "frame " + std::to_string(first);
  return "frames " + std::to_string(first) + " to " + std::to_string(last);
}

[[noreturn]] void refuse_gap(const std::vector<PartFrames>& parts, std::int64_t frame) {
  const PartFrames* before = nullptr;
  const PartFrames* after = nullptr;
  for (const PartFrames& part : parts) {
    if (part.end() == frame) before = &part;
    if (part.first > frame && (after == nullptr || part.first < after->first)) after = &part;
  }
  const std::int64_t last = after->first - 1;
  throw core::InputError(frames_text(frame, last) + (frame == last ? " is" : " are") +
                         " missing: " + before->path + " ends before, " + after->path +
                         " begins behind; name the file of the run between them, too");
}

}  // namespace

JoinPlan::JoinPlan(std::vector<PartFrames> parts, std::int64_t record_every)
    : parts_(std::move(parts)), record_every_(record_every) {
  std::int64_t end = parts_.front().end();
  for (const PartFrames& part : parts_) {
    core::require_input(part.count > 0, part.path + ": it has no frame; leave it out");
    end = std::max(end, part.end());
  }
  for (std::int64_t frame = first(); frame < end; ++frame) {
    std::size_t owner = parts_.size();
    while (owner > 0 && !parts_[owner - 1].has(frame)) --owner;
    if (owner == 0) refuse_gap(parts_, frame);
    if (stretches_.empty() || stretches_.back().part != owner - 1)
      stretches_.push_back({owner - 1, frame, 0});
    ++stretches_.back().count;
  }
  for (const Stretch& stretch : stretches_) {
    const PartFrames& part = parts_[stretch.part];
    core::require_input((part.first - first()) % record_every_ == 0,
                        part.path + ": one frame of " + std::to_string(record_every_) +
                            " is recorded, counted from its first, " + std::to_string(part.first) +
                            ", which is no such frame of " + parts_.front().path +
                            "; only runs that were saved after a multiple of as many frames can be joined");
  }
}

std::size_t JoinPlan::part_of(std::int64_t frame) const {
  for (const Stretch& stretch : stretches_) {
    if (frame < stretch.end()) return stretch.part;
  }
  return stretches_.back().part;
}

std::vector<Stretch> JoinPlan::overlaps_of(std::size_t part) const {
  std::vector<Stretch> overlaps;
  for (const Stretch& stretch : stretches_) {
    const std::int64_t begin = std::max(stretch.first, parts_[part].first);
    const std::int64_t end = std::min(stretch.end(), parts_[part].end());
    if (stretch.part != part && begin < end) overlaps.push_back({stretch.part, begin, end - begin});
  }
  return overlaps;
}

JoinPlan::Rows JoinPlan::recorded_rows(std::int64_t first, std::int64_t count, std::int64_t begin) const {
  const std::int64_t row = (first - begin) / record_every_;
  return {row, (first + count - begin) / record_every_ - row};
}

}  // namespace pbmpi::io
