/// Input files, which must not be pipes or devices that would block the program or never end.
#pragma once

#include <cstddef>
#include <string>

namespace pbmpi::core {

/// Throws InputError unless `path` names a readable regular file, or a link to one; `advice` says what to
/// give instead. Never blocks.
void require_readable_file(const std::string& path, const std::string& advice);

/// The file's bytes. Throws InputError like require_readable_file(), and for more than `most_bytes`.
std::string read_input_file(const std::string& path, const std::string& advice,
                            std::size_t most_bytes = std::size_t{64} << 20);

}  // namespace pbmpi::core
