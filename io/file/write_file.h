/// The one way in which a file is written whole.
#pragma once

#include <cstddef>
#include <functional>
#include <span>
#include <string>
#include <string_view>

#include "io/file/output_lock.h"

namespace pbmpi::io {

/// What a file holds, as far as it matters for what may take its place.
enum class Content {
  nothing,  ///< missing, empty, or no regular file
  hdf5,
  other
};
Content content_of(const std::string& path);

/// Puts `bytes` under the name `path`: written beside it under a name of this process's own, waited for until
/// they are on the disk, and renamed, with the rights of the file that was there. A kill at any moment leaves
/// the old file or the new one. Links are followed, also one that points to nothing. Devices, pipes and the
/// process's own open files (/dev/stdout) are written to and stay what they are. Throws core::InputError with
/// the system's reason, and then the old file stays: also if another process writes it, or if it is an HDF5
/// file, which a text never replaces.
void write_file(const std::string& path, std::string_view text);

/// Hands out a text piece by piece, where it is too long to be held.
using TextPieces = std::function<void(const std::function<void(std::string_view)>& put)>;
/// The same for such a text. What `pieces` throws leaves the old file, too.
void write_file(const std::string& path, const TextPieces& pieces);

/// The same for whoever holds the lock of the file, and for HDF5 files: these replace nothing else. Throws
/// core::RunError.
void replace_file(const OutputLock& lock, std::span<const std::byte> bytes);

/// Gives the file that is to replace `path` the rights of what is there.
void keep_rights(const core::Descriptor& file, const std::string& path);

}  // namespace pbmpi::io
