/// Makes the file of a killed run as short as that of a run which ended normally.
#pragma once

#include <cstdint>
#include <string>

namespace pbmpi::io {

struct Repair {
  std::int64_t frames = 0;       ///< committed; they stay as they are
  std::int64_t bytes_freed = 0;  ///< on the disk
};

/// Gives back the disk space after the committed frames of a run's file and cuts its datasets to them, as the
/// end of the run would have done; removes what else the killed run left next to it. A file that needs none
/// of this is not touched. Throws core::InputError if a run still writes the file, if it is not a run's file,
/// or if it cannot be opened for writing; core::RunError if a write fails.
Repair repair_run(const std::string& path);

}  // namespace pbmpi::io
