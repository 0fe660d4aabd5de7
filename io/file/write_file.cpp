#include "io/file/write_file.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <thread>

#include "core/error.h"
#include "core/system/paths.h"

namespace pbmpi::io {
namespace {

namespace fs = std::filesystem;

/// Flushes a folder, so that a new name in it survives a power failure. A file system that cannot do it does
/// not need it.
void sync_folder(const fs::path& folder) {
  const core::Descriptor opened(folder.empty() ? "." : folder.string(), O_RDONLY | O_DIRECTORY);
  if (opened.is_open()) fsync(opened.get());
}

[[noreturn]] void refuse(const std::string& path, const std::string& why) {
  throw core::InputError("cannot write " + path + ": " + why + "; choose another place");
}

[[noreturn]] void fail(const std::string& path, int error) {
  throw core::RunError("cannot write " + path + ": " + core::reason_of(error));
}

/// Hands out pieces of bytes in order; `put` returns 0 or the errno of a failure, after which it takes no
/// more.
using BytePieces = std::function<int(const std::function<int(std::span<const std::byte>)>& put)>;

BytePieces one_piece(std::span<const std::byte> bytes) {
  return [bytes](const auto& put) { return put(bytes); };
}

BytePieces bytes_of(const TextPieces& pieces) {
  return [&pieces](const auto& put) {
    int error = 0;
    pieces([&](std::string_view text) {
      if (error == 0) error = put(std::as_bytes(std::span(text)));
    });
    return error;
  };
}

/// Returns 0, or the errno of the failed call.
int write_new(const OutputLock& lock, const BytePieces& pieces) {
  core::Descriptor file(lock.temporary_path(), O_CREAT | O_WRONLY | O_TRUNC);
  if (!file.is_open()) return errno;
  keep_rights(file, lock.path());
  std::size_t written = 0;
  const int error = pieces([&](std::span<const std::byte> bytes) {
    written += bytes.size();
    // The limit is checked first: a write beyond it raises SIGXFSZ.
    return core::largest_file_bytes() < written ? EFBIG : file.write(bytes);
  });
  if (error != 0) return error;
  if (fsync(file.get()) != 0) return errno;
  return file.close();
}

/// Puts the new file in the place of the old one once it is complete.
void replace(const OutputLock& lock, const BytePieces& pieces) {
  int error = 0;
  try {
    error = write_new(lock, pieces);
  } catch (...) {
    unlink(lock.temporary_path().c_str());
    throw;
  }
  if (error == 0 && std::rename(lock.temporary_path().c_str(), lock.path().c_str()) != 0) error = errno;
  if (error != 0) {
    unlink(lock.temporary_path().c_str());
    fail(lock.path(), error);
  }
  sync_folder(fs::path(lock.path()).parent_path());
}

/// A name below /proc/PROCESS/fd, such as /dev/stdout, stands for an open file; a new file under that name
/// would reach nobody. `own`: its descriptor, if it is this process's.
struct OpenFile {
  bool is_one = false;
  int own = -1;
};

OpenFile open_file_of(const std::string& path) {
  fs::path current = path;
  std::error_code ignored;
  constexpr int most_links = 40;
  for (int i = 0; i < most_links && fs::is_symlink(current, ignored); ++i) {
    const fs::path folder = current.parent_path();
    const std::string where = fs::canonical(folder.empty() ? "." : folder, ignored).string();
    if (where.starts_with("/proc/")) {
      const bool own = where == "/proc/" + std::to_string(getpid()) + "/fd";
      return {true, own ? std::atoi(current.filename().c_str()) : -1};
    }
    const fs::path target = fs::read_symlink(current, ignored);
    current = target.is_absolute() ? target : folder / target;
  }
  return {};
}

/// Devices and pipes, except block devices.
bool is_stream(const std::string& path) {
  struct stat status {};
  if (stat(path.c_str(), &status) != 0) return false;
  return S_ISCHR(status.st_mode) || S_ISFIFO(status.st_mode) || S_ISSOCK(status.st_mode) ||
         open_file_of(path).is_one;
}

/// Opens a device or a pipe. A pipe that nobody opens for reading would make this process wait for ever; its
/// reader may start a little later.
core::Descriptor open_stream(const std::string& path) {
  using namespace std::chrono_literals;
  constexpr int most_tries = 100;
  core::Descriptor stream(path, O_WRONLY | O_NONBLOCK);
  for (int tries = 1; !stream.is_open() && errno == ENXIO && fs::is_fifo(path) && tries < most_tries;
       ++tries) {
    std::this_thread::sleep_for(50ms);
    stream = core::Descriptor(path, O_WRONLY | O_NONBLOCK);
  }
  if (stream.is_open()) fcntl(stream.get(), F_SETFL, fcntl(stream.get(), F_GETFL) & ~O_NONBLOCK);
  return stream;
}

void write_stream(const std::string& path, const BytePieces& pieces) {
  // A file that this process has open is written at its current position: opened anew it would be overwritten
  // from the start.
  if (const int own = open_file_of(path).own; own >= 0) {
    if (const int error =
            pieces([own](std::span<const std::byte> bytes) { return core::write_all(own, bytes); });
        error != 0)
      fail(path, error);
    return;
  }
  core::Descriptor stream = open_stream(path);
  if (!stream.is_open()) refuse(path, errno == ENXIO ? "nobody reads from it" : core::reason_of(errno));
  int error = pieces([&](std::span<const std::byte> bytes) { return stream.write(bytes); });
  if (error == 0) error = stream.close();
  if (error != 0) fail(path, error);
}

}  // namespace

Content content_of(const std::string& path) {
  struct stat status {};
  if (stat(path.c_str(), &status) != 0 || !S_ISREG(status.st_mode) || status.st_size == 0)
    return Content::nothing;
  // HDF5 looks for its signature at 0, 512, 1024, 2048 ...: before it a user may have put a block of their
  // own.
  constexpr std::array<char, 8> signature = {'\x89', 'H', 'D', 'F', '\r', '\n', '\x1a', '\n'};
  constexpr off_t first_block = 512;
  std::ifstream file(path, std::ios::binary);
  for (off_t at = 0; at < status.st_size && file; at = at == 0 ? first_block : 2 * at) {
    std::array<char, 8> found{};
    if (file.seekg(at) && file.read(found.data(), found.size()) && found == signature) return Content::hdf5;
  }
  return Content::other;
}

void write_file(const std::string& path, std::string_view text) {
  write_file(path, [text](const auto& put) { put(text); });
}

void write_file(const std::string& path, const TextPieces& pieces) {
  if (path.empty()) refuse("a file without a name", "the name is empty");
  if (is_stream(path)) return write_stream(path, bytes_of(pieces));
  struct stat status {};
  if (stat(path.c_str(), &status) == 0 && !S_ISREG(status.st_mode))
    refuse(path, S_ISDIR(status.st_mode) ? core::reason_of(EISDIR) : "it is a device");
  if (access(path.c_str(), F_OK) == 0 && access(path.c_str(), W_OK) != 0)
    refuse(path, core::reason_of(errno));
  if (content_of(path) == Content::hdf5) refuse(path, "an HDF5 file is there, which a text would destroy");
  const OutputLock lock(path);
  replace(lock, bytes_of(pieces));
}

void replace_file(const OutputLock& lock, std::span<const std::byte> bytes) {
  replace(lock, one_piece(bytes));
}

void keep_rights(const core::Descriptor& file, const std::string& path) {
  struct stat status {};
  constexpr mode_t all_rights = 07777;
  if (stat(path.c_str(), &status) == 0) static_cast<void>(!fchmod(file.get(), status.st_mode & all_rights));
}

}  // namespace pbmpi::io
