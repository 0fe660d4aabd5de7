/// Decides which process may write a file.
#pragma once

#include <string>

#include "core/system/descriptor.h"
#include "core/system/leftovers.h"

namespace pbmpi::io {

/// Throws core::InputError for an output that cannot be created.
[[noreturn]] void refuse_output(const std::string& path, const std::string& why, const std::string& advice);
/// `error`: the errno of creating a file in its folder.
[[noreturn]] void refuse_output_in_folder(const std::string& path, int error);

/// While a lock lives, no other process may write `path`, whatever links name it: neither on this host nor on
/// another host that sees the file system, as far as the file system passes locks on. It is a lock of the
/// system (flock) on `.NAME.lock` next to the file, so the death of the process frees it, whatever the cause.
/// The lock file is removed with the lock; a killed process leaves it behind, with no effect. On a file
/// system without locks the existence of the lock file is the lock; a lock file left by a dead process of
/// this host is then ignored, and one left by another host must be removed by hand.
///
/// A lock on the data would keep readers out, and the other ranks that write it.
class OutputLock {
 public:
  OutputLock() = default;
  /// Throws core::InputError if another process holds the lock (the message names host and process), or the
  /// folder cannot be written to, or something else than a regular file is in the place of the lock file.
  /// Removes what dead processes of this host, and the last holder, left unfinished. `has_locks`: whether the
  /// file system has locks, for tests.
  explicit OutputLock(const std::string& path, bool has_locks = true);
  ~OutputLock() { release(); }
  OutputLock(OutputLock&& other) noexcept = default;
  OutputLock& operator=(OutputLock&& other) noexcept;

  bool is_held() const { return file_.is_open(); }
  /// The final name, with links resolved.
  const std::string& path() const { return path_; }
  /// A name next to the file, NAME.HOST-PROCESS.part, that only this process uses for output that is not
  /// complete yet.
  const std::string& temporary_path() const { return temporary_path_; }
  void release();

 private:
  enum class Taken { yes, held, again };  ///< again: the lock file disappeared meanwhile
  Taken take();
  Taken take_by_name();
  void write_record();

  std::string path_, lock_path_, temporary_path_;
  core::Descriptor file_;
  core::Leftover lock_file_, temporary_file_;
};

}  // namespace pbmpi::io
