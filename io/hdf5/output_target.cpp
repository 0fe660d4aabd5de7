#include "io/hdf5/output_target.h"

#include <fcntl.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <sys/statvfs.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <filesystem>
#include <system_error>

#include "core/error.h"

namespace pbmpi::io {
namespace {

namespace fs = std::filesystem;

std::string reason(int error) { return std::generic_category().message(error); }

[[noreturn]] void refuse(const std::string& path, const std::string& why, const std::string& advice) {
  throw core::InputError("cannot create " + path + ": " + why + "; " + advice);
}

class Descriptor {
 public:
  Descriptor(const std::string& path, int flags) : fd_(open(path.c_str(), flags | O_CLOEXEC, 0666)) {}
  ~Descriptor() {
    if (fd_ >= 0) ::close(fd_);
  }
  Descriptor(const Descriptor&) = delete;
  Descriptor& operator=(const Descriptor&) = delete;
  int get() const { return fd_; }

 private:
  int fd_;
};

bool has_free(const std::string& path, std::int64_t bytes) {
  struct statvfs system {};
  if (statvfs(path.c_str(), &system) != 0) return true;
  return static_cast<double>(system.f_bavail) * static_cast<double>(system.f_frsize) >=
         static_cast<double>(bytes);
}

rlim_t largest_file() {
  rlimit limit{};
  return getrlimit(RLIMIT_FSIZE, &limit) == 0 ? limit.rlim_cur : RLIM_INFINITY;
}

/// errno of reserving `bytes` for the file, 0 if all went well. A file system that cannot reserve is only
/// asked for its free space.
int reserve(const Descriptor& file, const std::string& path, std::int64_t bytes) {
  // The limit is asked for first: a write beyond it raises SIGXFSZ.
  if (largest_file() < static_cast<rlim_t>(bytes)) return EFBIG;
  while (fallocate(file.get(), 0, 0, bytes) != 0) {
    if (errno == EOPNOTSUPP || errno == ENOSYS) return has_free(path, bytes) ? 0 : ENOSPC;
    if (errno != EINTR) return errno;
  }
  return 0;
}

void refuse_space(const std::string& path, std::int64_t bytes, int error) {
  refuse(path, "its " + std::to_string((bytes >> 20) + 1) + " MiB do not fit: " + reason(error),
         "free some space, record fewer frames (--record-every) or write elsewhere (--output)");
}

void require_replaceable(const fs::path& path) {
  std::error_code ignored;
  const fs::file_status status = fs::status(path, ignored);
  if (fs::is_directory(status)) refuse(path.string(), "it is a directory", "give the name of a file");
  if (!fs::exists(status)) return;
  if (!fs::is_regular_file(status)) refuse(path.string(), "it is not a regular file", "give another name");
  if (access(path.c_str(), W_OK) != 0)
    refuse(path.string(), reason(errno), "give another name or make it writable");
}

}  // namespace

OutputTarget::OutputTarget(const std::string& path, std::int64_t bytes) : path_(path) {
  std::error_code ignored;
  if (path.empty()) refuse("the output file", "its name is empty", "give the name of a file");
  if (fs::is_symlink(path, ignored)) path_ = fs::weakly_canonical(path, ignored).string();
  require_replaceable(path_);
  const fs::path folder = fs::path(path_).parent_path();
  if (!folder.empty() && !fs::is_directory(folder, ignored)) {
    refuse(path, "there is no directory " + folder.string(), "make it first or give another name");
  }
  const std::string temporary = path_ + ".part";
  const Descriptor file(temporary, O_CREAT | O_WRONLY | O_TRUNC);
  if (file.get() < 0) refuse(path, reason(errno), "give the name of a file in a directory you can write to");
  temporary_path_ = temporary;
  // HDF5 creates the file anew and reserves nothing; this only asks whether it would fit.
  if (const int error = reserve(file, temporary, bytes); error != 0) {
    unlink(temporary.c_str());
    refuse_space(path, bytes, error);
  }
}

OutputTarget::~OutputTarget() {
  if (!temporary_path_.empty()) unlink(temporary_path_.c_str());
}

OutputTarget::OutputTarget(OutputTarget&& other) noexcept
    : path_(std::move(other.path_)), temporary_path_(std::exchange(other.temporary_path_, {})) {}

OutputTarget& OutputTarget::operator=(OutputTarget&& other) noexcept {
  std::swap(path_, other.path_);
  std::swap(temporary_path_, other.temporary_path_);
  return *this;
}

void OutputTarget::publish() {
  const Descriptor file(temporary_path_, O_WRONLY);
  struct stat status {};
  if (file.get() < 0 || fstat(file.get(), &status) != 0) refuse(path_, reason(errno), "try again");
  if (const int error = reserve(file, temporary_path_, status.st_size); error != 0) {
    refuse_space(path_, status.st_size, error);
  }
  if (std::rename(temporary_path_.c_str(), path_.c_str()) != 0) {
    refuse(path_, reason(errno), "give another name");
  }
  temporary_path_.clear();
}

std::string OutputTarget::shortage() const {
  constexpr std::int64_t nothing_left = std::int64_t{64} * 1024;
  std::error_code ignored;
  if (fs::file_size(path_, ignored) > largest_file()) return reason(EFBIG);
  return has_free(path_, nothing_left) ? "" : reason(ENOSPC);
}

void OutputTarget::release(const std::vector<ByteRange>& unused) const {
  if (unused.empty()) return;
  const Descriptor file(path_, O_WRONLY);
  for (const auto& [offset, length] : unused) {
    if (file.get() < 0) return;
    if (fallocate(file.get(), FALLOC_FL_PUNCH_HOLE | FALLOC_FL_KEEP_SIZE, offset, length) != 0) return;
  }
}

}  // namespace pbmpi::io
