/// Identifies the file behind a name.
#pragma once

#include <span>
#include <string>

namespace pbmpi::core {

/// `path` with its links followed; the last one need not point to anything. Throws InputError for a cycle of
/// links.
std::string followed(const std::string& path);

/// Do both names refer to one file, by links, by other paths through the folders, or by its inode? They need
/// not exist. Devices and pipes do not count as files here: many may write to one.
bool is_same_file(const std::string& a, const std::string& b);

/// A file that a program reads or writes, and the option that names it.
struct NamedPath {
  std::string option;  ///< e.g. "--output", or a description of the file
  std::string path;
  bool written;
};

/// Throws InputError if one file is to be written twice, or both read and written (what is not there, such as
/// a scene that the program brings, is not read), or if the file system of one does not answer (mounts.h).
void require_separate(std::span<const NamedPath> paths);

}  // namespace pbmpi::core
