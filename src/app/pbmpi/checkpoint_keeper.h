/// Writes the checkpoints of a run.
#pragma once

#include <ostream>
#include <string>

#include "core/system/descriptor.h"
#include "io/run/checkpoint_file.h"
#include "mpi/frame/checkpoint_schedule.h"

namespace pbmpi::app {

/// Each snapshot replaces the file of the one before. Used on root.
class CheckpointKeeper final : public mpi::SnapshotKeeper {
 public:
  /// `about`: the file's content except a snapshot's part. `warnings`, borrowed, is told of a file that could
  /// not be written while the run goes on, and of one that somebody has removed or replaced.
  CheckpointKeeper(std::string path, io::Checkpoint about, std::ostream& warnings)
      : path_(std::move(path)), about_(std::move(about)), warnings_(&warnings) {}

  /// Claims the path of the checkpoints, of about so many bytes, for the lifetime of this object. Throws
  /// core::InputError if that is impossible, but only if checkpoints were `asked` for: otherwise the first
  /// keep() tries again.
  void reserve(std::int64_t bytes, bool asked);

  std::string keep(mpi::Snapshot snapshot) override;

  /// "FILE (after 12 frames)" of the last file written, or nothing if it is not there.
  const std::string& last() {
    notice_loss();
    return last_;
  }

 private:
  void notice_loss();

  std::string path_;
  io::OutputLock lock_;
  io::Checkpoint about_;
  std::ostream* warnings_;
  std::string last_;
  core::Descriptor written_;  ///< the last file
};

}  // namespace pbmpi::app
