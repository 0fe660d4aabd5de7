/// Decides which frames of a joined run come from which file.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace pbmpi::io {

/// The frames of a file, counted from the start of the first run.
struct PartFrames {
  std::string path;
  std::int64_t first = 0, count = 0;

  std::int64_t end() const { return first + count; }
  bool has(std::int64_t frame) const { return frame >= first && frame < end(); }
};

/// Consecutive frames that come from one file.
struct Stretch {
  std::size_t part = 0;
  std::int64_t first = 0, count = 0;

  std::int64_t end() const { return first + count; }
};

class JoinPlan {
 public:
  /// `parts` are sorted by first frame, and by their ends where those are equal. A frame that several parts
  /// have comes from the last of them. Throws core::InputError for frames that no part has, or for a part
  /// whose recording intervals do not continue those of the first.
  JoinPlan(std::vector<PartFrames> parts, std::int64_t record_every);

  const std::vector<PartFrames>& parts() const { return parts_; }
  const std::vector<Stretch>& stretches() const { return stretches_; }
  std::int64_t first() const { return parts_.front().first; }
  std::int64_t num_frames() const { return stretches_.back().end() - first(); }
  std::int64_t record_every() const { return record_every_; }
  /// The part from which a frame comes; the part of the last stretch for a frame after the end.
  std::size_t part_of(std::int64_t frame) const;
  /// Frames that `part` has, but that come from another part.
  std::vector<Stretch> overlaps_of(std::size_t part) const;
  /// Rows of the recorded frames among [first, first + count), in a file that begins with frame `begin`.
  struct Rows {
    std::int64_t first = 0, count = 0;
  };
  Rows recorded_rows(std::int64_t first, std::int64_t count, std::int64_t begin) const;

 private:
  std::vector<PartFrames> parts_;
  std::int64_t record_every_;
  std::vector<Stretch> stretches_;
};

}  // namespace pbmpi::io
