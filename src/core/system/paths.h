/// Which file a name stands for, whatever it is called by.
#pragma once

#include <span>
#include <string>

namespace pbmpi::core {

/// `path` with the links followed that it names, the last of which need not point to anything. Throws
/// InputError if they go round in a circle.
std::string followed(const std::string& path);

/// Do both name one file, by links, by other ways through the folders, or by its inode? They need not exist.
/// Devices and pipes are no files here: many may write to one.
bool is_same_file(const std::string& a, const std::string& b);

/// A file that a program reads or writes, and by which option it came.
struct NamedPath {
  std::string option;  ///< e.g. "--output", or what the file is
  std::string path;
  bool written;
};

/// Throws InputError if one file is to be written twice, or to be read and written.
void require_separate(std::span<const NamedPath> paths);

}  // namespace pbmpi::core
