/// Makes the file of a killed run as short as that of a run which ended by itself.
#pragma once

#include <cstdint>
#include <string>

namespace pbmpi::io {

struct Repair {
  std::int64_t frames = 0;       ///< committed; they stay as they are
  std::int64_t bytes_freed = 0;  ///< of the disk
};

/// Gives back the disk space behind the committed frames of a run's file and cuts its datasets to them, as
/// the end of a run would have done; removes what else the killed run left beside it. A file that needs none
/// of it stays as it is. Throws core::InputError: a run still writes the file, it is no run's file, or cannot
/// be written.
Repair repair_run(const std::string& path);

}  // namespace pbmpi::io
