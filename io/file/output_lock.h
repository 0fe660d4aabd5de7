/// Who may write a file.
#pragma once

#include <string>

#include "core/system/descriptor.h"
#include "core/system/leftovers.h"

namespace pbmpi::io {

/// Throws core::InputError: an output cannot be created.
[[noreturn]] void refuse_output(const std::string& path, const std::string& why, const std::string& advice);
/// `error`: the errno of making a file in its folder.
[[noreturn]] void refuse_output_in_folder(const std::string& path, int error);

/// While one lives nobody else may write `path`, by whatever links it is named: not on this host, nor on
/// another one that sees the file system, as far as that passes locks on. It is a lock of the system (flock)
/// on a file beside it, `.NAME.lock`, so that the death of the process frees it, whatever it dies of. The
/// file goes with the lock; a killed process leaves it, of no effect. On a file system without locks the file
/// itself is the lock; then one that is left by a dead process of this host counts for nothing, and one of
/// another host must be removed by hand.
///
/// A lock on the data would keep readers out, and on a network file system MPI-IO too.
class OutputLock {
 public:
  OutputLock() = default;
  /// Throws core::InputError: another process holds it (the message names host and process), or the folder
  /// cannot be written to. What a dead holder left unfinished is removed. `has_locks`: for tests, what the
  /// file system can do.
  explicit OutputLock(const std::string& path, bool has_locks = true);
  ~OutputLock() { release(); }
  OutputLock(OutputLock&& other) noexcept = default;
  OutputLock& operator=(OutputLock&& other) noexcept;

  bool is_held() const { return file_.is_open(); }
  /// The final name, links followed.
  const std::string& path() const { return path_; }
  /// A name of this process's own beside it, NAME.HOST-PROCESS.part, for what is not complete yet.
  const std::string& temporary_path() const { return temporary_path_; }
  void release();

 private:
  enum class Taken { yes, held, again };  ///< again: the lock file went away meanwhile
  Taken take();
  Taken take_by_name();
  void write_record();

  std::string path_, lock_path_, temporary_path_;
  core::Descriptor file_;
  core::Leftover lock_file_, temporary_file_;
};

}  // namespace pbmpi::io
