/// Detects file systems that do not answer.
#pragma once

#include <span>
#include <string>

namespace pbmpi::core {

struct NamedPath;

/// Throws InputError for the first path whose file system does not answer within 10 s: a mount whose server
/// is gone. Any other call on such a path blocks the process, in a way that a signal may not end. A path need
/// not exist. Child processes ask, one for each path, and those that are blocked are left behind. To be
/// called before anything else is done with a path that is to be written.
void require_answers(std::span<const NamedPath> paths);

}  // namespace pbmpi::core
