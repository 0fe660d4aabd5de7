/// Which frames of a joined run come from which file.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace pbmpi::io {

/// The frames that a file has, counted from the start of the first run.
struct PartFrames {
  std::string path;
  std::int64_t first = 0, count = 0;

  std::int64_t end() const { return first + count; }
  bool has(std::int64_t frame) const { return frame >= first && frame < end(); }
};

/// Neighbouring frames that come from one file.
struct Stretch {
  std::size_t part = 0;
  std::int64_t first = 0, count = 0;

  std::int64_t end() const { return first + count; }
};

class JoinPlan {
 public:
  /// `parts` by first frame, and by their ends where that is equal. What several have comes from the last of
  /// them. Throws core::InputError: frames that none has, or a part whose intervals of recording do not go on
  /// where those of the first stop.
  JoinPlan(std::vector<PartFrames> parts, std::int64_t record_every);

  const std::vector<PartFrames>& parts() const { return parts_; }
  const std::vector<Stretch>& stretches() const { return stretches_; }
  std::int64_t first() const { return parts_.front().first; }
  std::int64_t num_frames() const { return stretches_.back().end() - first(); }
  std::int64_t record_every() const { return record_every_; }
  /// The part from which a frame comes; of one behind the end the last stretch's.
  std::size_t part_of(std::int64_t frame) const;
  /// Frames that `part` has, and that come from another one.
  std::vector<Stretch> overlaps_of(std::size_t part) const;
  /// Rows of the recorded frames of [first, first + count), of a file that begins with frame `begin`.
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
