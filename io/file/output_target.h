/// The name under which a run's file appears, and the disk space behind it. Serial: root only.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "core/system/descriptor.h"
#include "io/file/output_lock.h"

namespace pbmpi::io {

/// An HDF5 file that is made under a temporary name in its directory and appears under its own name when
/// publish() is called. Until then the destructor removes it. While one lives, no other process may write the
/// file.
class OutputTarget {
 public:
  OutputTarget() = default;
  /// Throws core::InputError, and leaves nothing behind, if `path` cannot be created, is written by another
  /// process, is something else than a file, or a file that is not HDF5, or `bytes` do not fit on the disk.
  OutputTarget(const std::string& path, std::int64_t bytes);
  ~OutputTarget();
  OutputTarget(OutputTarget&& other) noexcept = default;
  OutputTarget& operator=(OutputTarget&& other) noexcept;

  /// The final name, links resolved.
  const std::string& path() const { return lock_.path(); }
  const std::string& temporary_path() const { return lock_.temporary_path(); }
  /// Renames the file. Throws core::InputError, also if the disk has no room for the length that it has by
  /// now, but for so many bytes of it that it is not expected to need.
  void publish(std::int64_t spare_bytes = 0);
  /// Drops the unpublished file; the right to write it goes to the caller.
  OutputLock take_lock();
  /// A name of the very file that was published, also when another one has taken its place since.
  std::string open_path() const;
  /// Throws core::RunError if the published file no longer has its name: somebody has removed or replaced it.
  void require_in_place() const;
  /// Why a write may just have failed, which MPI-IO does not tell: a full disk or a limit on the size of
  /// files. Empty if neither is the case.
  std::string shortage() const;
  /// Takes disk space for bytes that are about to be written, where the file system can; elsewhere asks
  /// whether there is enough. Empty, or why it cannot be had.
  std::string reserve(const std::vector<core::ByteRange>& ranges) const;
  /// Gives disk space back that the file reserved and never used. Best effort.
  void release(const std::vector<core::ByteRange>& unused) const;

 private:
  void remove_unpublished();

  OutputLock lock_;
  core::Descriptor file_;  ///< open from the start, so that nobody can put another one in its place
  bool is_published_ = false;
};

}  // namespace pbmpi::io
