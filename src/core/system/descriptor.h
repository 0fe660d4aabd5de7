/// Owner of a file descriptor, and the few calls on it, each made in one place.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <utility>
#include <vector>

namespace pbmpi::core {

/// Move-only. Programs that this program starts do not inherit it.
class Descriptor {
 public:
  Descriptor() = default;
  /// open(2) with all rights except those that the umask removes; errno says why if get() is below 0.
  Descriptor(const std::string& path, int flags);
  ~Descriptor() { close(); }
  Descriptor(Descriptor&& other) noexcept : fd_(std::exchange(other.fd_, -1)) {}
  Descriptor& operator=(Descriptor&& other) noexcept {
    std::swap(fd_, other.fd_);
    return *this;
  }

  int get() const { return fd_; }
  bool is_open() const { return fd_ >= 0; }
  /// 0, or the errno of closing, which may come from an earlier write.
  int close();
  /// Does `path` name the open file?
  bool is_at(const std::string& path) const;
  /// 0, or the errno of the failure.
  int write(std::span<const std::byte> bytes) const;

 private:
  int fd_ = -1;
};

/// Writes all bytes to an open file: 0, or the errno of the failure.
int write_all(int fd, std::span<const std::byte> bytes);

/// The system's words for an errno.
std::string reason_of(int error);

/// RLIMIT_FSIZE in bytes; a write beyond it raises SIGXFSZ.
std::uint64_t largest_file_bytes();

/// A range of bytes of a file: offset, length.
using ByteRange = std::pair<std::int64_t, std::int64_t>;

/// Frees the disk space of these ranges, which then read as zeros. Best effort.
void punch_holes(int fd, const std::vector<ByteRange>& ranges);

}  // namespace pbmpi::core
