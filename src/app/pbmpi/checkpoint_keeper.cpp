#include "app/pbmpi/checkpoint_keeper.h"

#include <fcntl.h>

#include <filesystem>
#include <utility>

#include "core/error.h"
#include "core/hash.h"
#include "core/utc.h"

namespace pbmpi::app {

void CheckpointKeeper::reserve(std::int64_t bytes, bool asked) {
  try {
    lock_ = io::lock_checkpoint(path_, bytes);
  } catch (const core::InputError&) {
    if (asked) throw;
  }
}

void CheckpointKeeper::notice_loss() {
  if (last_.empty() || written_.is_at(path_)) return;
  *warnings_ << "pbmpi: warning: the checkpoint " << path_ << " was removed or replaced by somebody"
             << std::endl;
  written_ = {};
  last_.clear();
}

std::string CheckpointKeeper::keep(mpi::Snapshot snapshot) {
  notice_loss();
  about_.created = core::utc_now();
  about_.frames = snapshot.frames;
  about_.steps = snapshot.steps;
  about_.state_hash = core::to_hex(snapshot.state_hash);
  about_.worlds = std::move(snapshot.worlds);
  try {
    if (!lock_.is_held()) lock_ = io::lock_checkpoint(path_, 1);
    const std::int64_t bytes = io::write_checkpoint(lock_, about_);
    about_.worlds.clear();
    written_ = core::Descriptor(path_, O_RDONLY);
    last_ = path_ + " (after " + std::to_string(snapshot.frames) + " frames)";
    return std::filesystem::path(path_).filename().string() + " holds the run after step " +
           std::to_string(snapshot.steps) + " (" + std::to_string((bytes + 1023) / 1024) + " KiB)";
  } catch (const std::runtime_error& error) {  // also an InputError: whose mistake it was no longer matters
    about_.worlds.clear();
    if (!snapshot.ends_run) {
      *warnings_ << "pbmpi: warning: no checkpoint in frame " << snapshot.frames - 1 << ": " << error.what()
                 << "; the run goes on" << std::endl;
    }
    throw core::RunError(error.what());
  }
}

}  // namespace pbmpi::app
