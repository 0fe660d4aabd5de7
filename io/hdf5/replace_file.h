/// A file that is written whole, or not at all.
#pragma once

#include <cstddef>
#include <span>
#include <string>

namespace pbmpi::io {

/// Puts `bytes` under the name `path`: written beside it (`path`.part), waited for until they are on the
/// disk, and renamed. A kill at any moment leaves the old file or the new one. Throws core::RunError with the
/// system's reason, and then the old file stays.
void replace_file(const std::string& path, std::span<const std::byte> bytes);

}  // namespace pbmpi::io
