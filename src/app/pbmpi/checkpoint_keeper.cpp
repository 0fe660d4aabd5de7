#include "app/pbmpi/checkpoint_keeper.h"

#include <filesystem>
#include <utility>

#include "core/error.h"
#include "core/hash.h"
#include "core/utc.h"

namespace pbmpi::app {

std::string CheckpointKeeper::keep(mpi::Snapshot snapshot) {
  about_.created = core::utc_now();
  about_.frames = snapshot.frames;
  about_.steps = snapshot.steps;
  about_.state_hash = core::to_hex(snapshot.state_hash);
  about_.worlds = std::move(snapshot.worlds);
  try {
    const std::int64_t bytes = io::write_checkpoint(path_, about_);
    about_.worlds.clear();
    last_ = path_ + " (after " + std::to_string(snapshot.frames) + " frames)";
    return std::filesystem::path(path_).filename().string() + " holds the run after step " +
           std::to_string(snapshot.steps) + " (" + std::to_string((bytes + 1023) / 1024) + " KiB)";
  } catch (const core::RunError& error) {
    about_.worlds.clear();
    if (!snapshot.ends_run) {
      *warnings_ << "pbmpi: warning: no checkpoint in frame " << snapshot.frames - 1 << ": " << error.what()
                 << "; the run goes on" << std::endl;
    }
    throw;
  }
}

}  // namespace pbmpi::app
