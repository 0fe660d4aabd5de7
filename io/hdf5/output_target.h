/// The name under which a run's file appears, and the disk space behind it. Serial: root only.
#pragma once

#include <cstdint>
#include <string>
#include <utility>
#include <vector>

namespace pbmpi::io {

/// A range of bytes of a file: offset, length.
using ByteRange = std::pair<std::int64_t, std::int64_t>;

/// A file that is made under a temporary name in its directory and appears under its own name when publish()
/// is called. Until then the destructor removes it.
class OutputTarget {
 public:
  OutputTarget() = default;
  /// Throws core::InputError, and leaves nothing behind, if `path` cannot be created, is something else than
  /// a file, or `bytes` do not fit on the disk.
  OutputTarget(const std::string& path, std::int64_t bytes);
  ~OutputTarget();
  OutputTarget(OutputTarget&& other) noexcept;
  OutputTarget& operator=(OutputTarget&& other) noexcept;

  /// The final name, links resolved.
  const std::string& path() const { return path_; }
  const std::string& temporary_path() const { return temporary_path_; }
  /// Reserves the disk space of the whole file, so that the disk cannot become full in mid-run, and renames
  /// it. Throws core::InputError.
  void publish();
  /// Why a write may just have failed, which MPI-IO does not tell: a full disk or a limit on the size of
  /// files. Empty if neither is the case.
  std::string shortage() const;
  /// Gives disk space back that the file reserved and never used. Best effort.
  void release(const std::vector<ByteRange>& unused) const;

 private:
  std::string path_;  ///< resolved, so that the rename replaces the file and not a link to it
  std::string temporary_path_;
};

}  // namespace pbmpi::io
