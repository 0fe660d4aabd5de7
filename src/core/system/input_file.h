/// What a program reads: a file, and no pipe or device that would block it or never end.
#pragma once

#include <cstddef>
#include <string>

namespace pbmpi::core {

/// Throws InputError unless `path` names a regular file, or a link to one, that can be read; `advice` says
/// what to give instead. Never blocks.
void require_readable_file(const std::string& path, const std::string& advice);

/// The file's bytes. Throws InputError as require_readable_file() does, and beyond `most_bytes`.
std::string read_input_file(const std::string& path, const std::string& advice,
                            std::size_t most_bytes = std::size_t{64} << 20);

}  // namespace pbmpi::core
