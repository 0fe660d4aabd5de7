#include "io/hdf5/replace_file.h"

#include <fcntl.h>
#include <sys/resource.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <filesystem>
#include <system_error>

#include "core/error.h"

namespace pbmpi::io {
namespace {

namespace fs = std::filesystem;

/// Returns 0, or the errno of what failed.
int write_all(int fd, std::span<const std::byte> bytes) {
  rlimit limit{};
  // The limit is asked for first: a write beyond it raises SIGXFSZ.
  if (getrlimit(RLIMIT_FSIZE, &limit) == 0 && limit.rlim_cur < bytes.size()) return EFBIG;
  while (!bytes.empty()) {
    const ssize_t written = write(fd, bytes.data(), bytes.size());
    if (written < 0 && errno != EINTR) return errno;
    if (written > 0) bytes = bytes.subspan(static_cast<std::size_t>(written));
  }
  return fsync(fd) == 0 ? 0 : errno;
}

int write_new(const std::string& path, std::span<const std::byte> bytes) {
  const int fd = open(path.c_str(), O_CREAT | O_WRONLY | O_TRUNC | O_CLOEXEC, 0666);
  if (fd < 0) return errno;
  const int error = write_all(fd, bytes);
  return close(fd) != 0 && error == 0 ? errno : error;
}

/// Flushes a folder, so that a new name in it outlives a power failure. File systems that cannot do it need
/// not.
void sync_folder(const fs::path& folder) {
  const int fd = open(folder.empty() ? "." : folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
  if (fd < 0) return;
  fsync(fd);
  close(fd);
}

}  // namespace

void replace_file(const std::string& path, std::span<const std::byte> bytes) {
  std::error_code ignored;
  // The rename replaces the file and not a link to it.
  const std::string target =
      fs::is_symlink(path, ignored) ? fs::weakly_canonical(path, ignored).string() : path;
  const std::string temporary = target + ".part";
  int error = write_new(temporary, bytes);
  if (error == 0 && std::rename(temporary.c_str(), target.c_str()) != 0) error = errno;
  if (error != 0) {
    unlink(temporary.c_str());
    throw core::RunError("cannot write " + path + ": " + std::generic_category().message(error));
  }
  sync_folder(fs::path(target).parent_path());
}

}  // namespace pbmpi::io
