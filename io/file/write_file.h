/// Writes whole files, each in one go.
#pragma once

#include <cstddef>
#include <functional>
#include <span>
#include <string>
#include <string_view>

#include "io/file/output_lock.h"

namespace pbmpi::io {

/// What a file holds, as far as it decides whether it may be replaced.
enum class Content {
  nothing,  ///< missing, empty, or no regular file
  hdf5,
  other
};
Content content_of(const std::string& path);

/// Puts `bytes` under the name `path`: writes them next to it under a name of this process's own, waits until
/// they are on the disk, and renames, keeping the permissions of the old file. A kill at any moment leaves
/// either the old file or the new one. Links are followed, even one that points to nothing. Devices, pipes
/// and the process's own open files (/dev/stdout) are written to directly. Throws core::InputError for a
/// place that cannot be written to, a pipe that nobody opens for reading within 5 s, a file that another
/// process writes, and an HDF5 file, which a text never replaces; core::RunError with the system's reason if
/// a write fails (a full disk). Keeps the old file then.
void write_file(const std::string& path, std::string_view text);

/// Hands out a text piece by piece, where it is too long to be held.
using TextPieces = std::function<void(const std::function<void(std::string_view)>& put)>;
/// write_file() for such a text. If `pieces` throws, the old file stays as well.
void write_file(const std::string& path, const TextPieces& pieces);

/// write_file() for the holder of the file's lock, with the bytes of an HDF5 file, which replaces only an
/// HDF5 file. Throws core::RunError.
void replace_file(const OutputLock& lock, std::span<const std::byte> bytes);

/// Gives the file that is to replace `path` the permissions of the existing one.
void keep_rights(const core::Descriptor& file, const std::string& path);

}  // namespace pbmpi::io
