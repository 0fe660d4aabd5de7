#include "io/file/descriptor.h"

#include <fcntl.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <filesystem>
#include <limits>
#include <system_error>

#include "core/hash.h"

namespace pbmpi::io {

Descriptor::Descriptor(const std::string& path, int flags)
    : fd_(open(path.c_str(), flags | O_CLOEXEC, 0666)) {}

int Descriptor::close() {
  if (fd_ < 0) return 0;
  return ::close(std::exchange(fd_, -1)) == 0 ? 0 : errno;
}

bool Descriptor::is_at(const std::string& path) const {
  struct stat open {
  }, named{};
  return fd_ >= 0 && fstat(fd_, &open) == 0 && stat(path.c_str(), &named) == 0 &&
         open.st_dev == named.st_dev && open.st_ino == named.st_ino;
}

int Descriptor::write(std::span<const std::byte> bytes) const { return write_all(fd_, bytes); }

int write_all(int fd, std::span<const std::byte> bytes) {
  while (!bytes.empty()) {
    const ssize_t written = ::write(fd, bytes.data(), bytes.size());
    if (written < 0 && errno != EINTR) return errno;
    if (written > 0) bytes = bytes.subspan(static_cast<std::size_t>(written));
  }
  return 0;
}

std::string reason_of(int error) { return std::generic_category().message(error); }

std::uint64_t largest_file_bytes() {
  rlimit limit{};
  return getrlimit(RLIMIT_FSIZE, &limit) == 0 && limit.rlim_cur != RLIM_INFINITY
             ? limit.rlim_cur
             : std::numeric_limits<std::uint64_t>::max();
}

std::string beside(const std::string& path, const std::string& prefix, const std::string& suffix) {
  constexpr std::size_t longest_name = 255, hash_digits = 16;
  const std::filesystem::path file(path);
  std::string name = file.filename().string();
  const std::size_t added = prefix.size() + suffix.size();
  if (name.size() <= longest_name && name.size() + added > longest_name) {
    core::Hash64 hash;
    for (const char letter : name) hash.add(static_cast<std::uint64_t>(static_cast<unsigned char>(letter)));
    name = name.substr(0, longest_name - added - hash_digits) + core::to_hex(hash.value());
  }
  return (file.parent_path() / (prefix + name + suffix)).string();
}

}  // namespace pbmpi::io
