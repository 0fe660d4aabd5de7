#include "io/file/output_target.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <sys/statvfs.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <filesystem>
#include <system_error>

#include "core/error.h"
#include "core/system/paths.h"
#include "io/file/write_file.h"

namespace pbmpi::io {
namespace {

namespace fs = std::filesystem;

bool has_free(const std::string& path, std::int64_t bytes) {
  struct statvfs system {};
  if (statvfs(path.c_str(), &system) != 0) return true;
  return static_cast<double>(system.f_bavail) * static_cast<double>(system.f_frsize) >=
         static_cast<double>(bytes);
}

/// Reserves `bytes` for the file; returns errno, 0 on success. A file system that cannot reserve is only
/// asked for its free space.
int reserve_whole(const core::Descriptor& file, const std::string& path, std::int64_t bytes) {
  // The limit is checked first: a write beyond it raises SIGXFSZ.
  if (core::largest_file_bytes() < static_cast<std::uint64_t>(bytes)) return EFBIG;
  while (fallocate(file.get(), 0, 0, bytes) != 0) {
    if (errno == EOPNOTSUPP || errno == ENOSYS) return has_free(path, bytes) ? 0 : ENOSPC;
    if (errno != EINTR) return errno;
  }
  return 0;
}

void refuse_space(const std::string& path, std::int64_t bytes, int error) {
  refuse_output(path,
                "its " + std::to_string((bytes >> 20) + 1) + " MiB do not fit: " + core::reason_of(error),
                "free some space, record fewer frames (--record-every) or write elsewhere (--output)");
}

void require_replaceable(const fs::path& path) {
  std::error_code ignored;
  const fs::file_status status = fs::status(path, ignored);
  if (fs::is_directory(status)) refuse_output(path.string(), "it is a directory", "give the name of a file");
  if (!fs::exists(status)) return;
  if (!fs::is_regular_file(status))
    refuse_output(path.string(), "it is not a regular file", "give another name");
  if (access(path.c_str(), W_OK) != 0)
    refuse_output(path.string(), core::reason_of(errno), "give another name or make it writable");
  if (content_of(path.string()) == Content::other)
    refuse_output(path.string(), "it is there, and no HDF5 file", "give another name, or remove it first");
}

}  // namespace

OutputTarget::OutputTarget(const std::string& path, std::int64_t bytes) {
  if (path.empty()) refuse_output("the output file", "its name is empty", "give the name of a file");
  const std::string target = core::followed(path);
  require_replaceable(target);
  std::error_code ignored;
  const fs::path folder = fs::path(target).parent_path();
  if (!folder.empty() && !fs::is_directory(folder, ignored)) {
    refuse_output(path, "there is no directory " + folder.string(), "make it first or give another name");
  }
  lock_ = OutputLock(path);
  file_ = core::Descriptor(temporary_path(), O_CREAT | O_RDWR | O_TRUNC);
  if (!file_.is_open()) refuse_output_in_folder(path, errno);
  // This only checks that the file would fit: SpaceAhead decides what is reserved ahead of the rows.
  if (const int error = reserve_whole(file_, temporary_path(), bytes); error != 0) {
    remove_unpublished();
    refuse_space(path, bytes, error);
  }
  static_cast<void>(!ftruncate(file_.get(), 0));
}

OutputTarget::~OutputTarget() { remove_unpublished(); }

OutputTarget& OutputTarget::operator=(OutputTarget&& other) noexcept {
  if (this == &other) return *this;
  remove_unpublished();
  lock_ = std::move(other.lock_);
  file_ = std::move(other.file_);
  is_published_ = other.is_published_;
  published_bytes_ = other.published_bytes_;
  return *this;
}

void OutputTarget::remove_unpublished() {
  if (file_.is_open() && !is_published_) unlink(temporary_path().c_str());
  file_.close();
}

void OutputTarget::publish(std::int64_t spare_bytes) {
  struct stat status {};
  if (fstat(file_.get(), &status) != 0) refuse_output(path(), core::reason_of(errno), "try again");
  constexpr std::int64_t block_bytes = 512;
  const bool within_limit = static_cast<std::uint64_t>(status.st_size) <= core::largest_file_bytes();
  if (!within_limit ||
      !has_free(temporary_path(), status.st_size - spare_bytes - block_bytes * status.st_blocks))
    refuse_space(path(), status.st_size, within_limit ? ENOSPC : EFBIG);
  keep_rights(file_, path());
  if (std::rename(temporary_path().c_str(), path().c_str()) != 0) {
    refuse_output(path(), core::reason_of(errno), "give another name");
  }
  is_published_ = true;
  published_bytes_ = status.st_size;
}

OutputLock OutputTarget::take_lock() {
  remove_unpublished();
  return std::move(lock_);
}

std::string OutputTarget::open_path() const {
  const std::string own = "/proc/self/fd/" + std::to_string(file_.get());
  return file_.is_at(own) ? own : path();
}

void OutputTarget::require_in_place() const {
  if (file_.is_at(path())) return;
  throw core::RunError(
      path() +
      " was removed or replaced by somebody while this run wrote it; run again, or go on from a checkpoint "
      "(--resume), and leave the file alone");
}

void OutputTarget::require_whole() const {
  struct stat status {};
  if (fstat(file_.get(), &status) == 0 && status.st_size >= published_bytes_) return;
  throw core::RunError("somebody has cut the file short while this run wrote it");
}

std::string OutputTarget::reserve(const std::vector<core::ByteRange>& ranges) const {
  for (const auto& [offset, length] : ranges) {
    while (fallocate(file_.get(), FALLOC_FL_KEEP_SIZE, offset, length) != 0) {
      if (errno == EOPNOTSUPP || errno == ENOSYS)
        return has_free(path(), length) ? "" : core::reason_of(ENOSPC);
      if (errno != EINTR) return core::reason_of(errno);
    }
  }
  return "";
}

void OutputTarget::release(const std::vector<core::ByteRange>& unused) const {
  core::punch_holes(file_.get(), unused);
}

}  // namespace pbmpi::io
