/// Attributes of a run's file that change while it grows: root alone writes them, after the data.
#pragma once

#include <cstdint>
#include <map>
#include <string>

#include "io/hdf5/written_file.h"

namespace pbmpi::io {

/// Digits of state_hash.
inline constexpr std::size_t hash_digits = 16;

/// Counts among the attributes of /events: name -> number.
using EventCounts = std::map<std::string, std::int64_t>;

/// Creates the attributes that a CommitRecord overwrites, at their final size: a later change is a few bytes
/// in place. Part of the skeleton.
void create_commit_attributes(hid_t root, hid_t events, const EventCounts& counts);

/// Root's own handle of the file, separate from the one through which all ranks write data.
class CommitRecord {
 public:
  CommitRecord() = default;
  explicit CommitRecord(const std::string& path) : file_(WrittenFile::open(path)) {}

  /// Declares the first frames committed; the caller has made sure that their rows are in the file.
  void commit(std::int64_t num_frames, const EventCounts& events);
  /// Stores what is known only at the end of the run.
  void finish(bool complete, const std::string& state_hash, const EventCounts& events);
  /// Its handle of the file, for looking at datasets.
  hid_t id() const { return file_.id(); }
  /// Throws core::RunError unless all of it is written.
  void close() { file_.close(); }

 private:
  void rewrite_counts(const EventCounts& events);

  WrittenFile file_;
};

}  // namespace pbmpi::io
