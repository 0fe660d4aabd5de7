/// The name under which a run's file appears, and the disk space behind it. Serial: root only.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "core/system/descriptor.h"
#include "io/file/output_lock.h"

namespace pbmpi::io {

/// An HDF5 file that is made under a temporary name in its directory and gets its own name in publish().
/// Before that the destructor removes it. While an OutputTarget lives, no other process may write the file.
class OutputTarget {
 public:
  OutputTarget() = default;
  /// Throws core::InputError, and leaves nothing behind, if `path` cannot be created, is written by another
  /// process, is not a regular file, or is a file but not HDF5, or if `bytes` do not fit on the disk.
  OutputTarget(const std::string& path, std::int64_t bytes);
  ~OutputTarget();
  OutputTarget(OutputTarget&& other) noexcept = default;
  OutputTarget& operator=(OutputTarget&& other) noexcept;

  /// The final name, with links resolved.
  const std::string& path() const { return lock_.path(); }
  const std::string& temporary_path() const { return lock_.temporary_path(); }
  /// Renames the file. Throws core::InputError, also if the disk has no room for the file's present length
  /// less `spare_bytes`, which it is not expected to need.
  void publish(std::int64_t spare_bytes = 0);
  /// Drops the unpublished file and passes the right to write it to the caller.
  OutputLock take_lock();
  /// A name of the published file itself, valid even if another file has taken its place since.
  std::string open_path() const;
  /// Throws core::RunError if the published file no longer has its name: somebody removed or replaced it.
  void require_in_place() const;
  /// Throws core::RunError if the file is shorter than when it was published: somebody has cut it.
  void require_whole() const;
  /// Reserves disk space for bytes that are about to be written, where the file system can; elsewhere checks
  /// that there is enough. Returns empty, or the reason why there is no space.
  std::string reserve(const std::vector<core::ByteRange>& ranges) const;
  /// Gives back disk space that the file reserved and never used. Best effort.
  void release(const std::vector<core::ByteRange>& unused) const;

 private:
  void remove_unpublished();

  OutputLock lock_;
  core::Descriptor file_;  ///< open from the start, so that nobody can put another file in its place
  bool is_published_ = false;
  std::int64_t published_bytes_ = 0;
};

}  // namespace pbmpi::io
