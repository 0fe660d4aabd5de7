/// An HDF5 file that is open for writing.
#pragma once

#include <memory>
#include <string>
#include <utility>

#include "io/hdf5/hdf5_handle.h"

namespace pbmpi::io {

/// Move-only owner of an open file, with a file driver of its own. Writes go to the system at once, so that a
/// kill between two of them never leaves a superblock that lags behind the length of the file. All calls
/// throw core::RunError.
///
/// HDF5 never hears of a write that failed: it would keep what it could not write, try again when the file is
/// closed, and crash as the library ends; with its own driver for MPI-IO ranks would wait for each other in
/// vain, too. The first failure is remembered, nothing is written after it, and require_written(), flush()
/// and close() throw the system's reason.
class WrittenFile {
 public:
  WrittenFile() = default;
  /// Makes a file, or empties the one that is there.
  static WrittenFile create(const std::string& path);
  /// Opens a file. One process alone may have it open so.
  static WrittenFile open(const std::string& path);
  /// Opens a file only to write values of datasets that are allocated, as any number of processes may at the
  /// same time; what HDF5 would write besides is dropped. Values are not cached.
  static WrittenFile open_values(const std::string& path);

  hid_t id() const { return open_ ? open_->file.id() : -1; }
  /// Throws if any write has failed since the file was opened.
  void require_written() const;
  /// Hands everything to the system.
  void flush();
  /// Waits until everything is on the disk.
  void sync();
  /// The destructor closes the file as well, and drops errors.
  void close();

 private:
  struct Open {
    bool values_only = false;
    int descriptor = -1;
    int error = 0;  ///< errno of the first write that failed
    File file;
  };
  explicit WrittenFile(std::unique_ptr<Open> open) : open_(std::move(open)) {}
  static std::unique_ptr<Open> begin(bool values_only, PropertyList& access);

  std::unique_ptr<Open> open_;
};

}  // namespace pbmpi::io
