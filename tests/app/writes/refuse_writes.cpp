// Preloaded, it is a file system that goes on refusing writes, as one over its quota does, or whose server
// has died: from the REFUSE_FROM-th call on that writes to, resizes or flushes a file below REFUSE_UNDER,
// each fails with EDQUOT. REFUSE_RANK: on this rank alone. Each such call appends its number
// to REFUSE_COUNTS.
#include <dlfcn.h>
#include <fcntl.h>
#include <sys/uio.h>
#include <unistd.h>

#include <array>
#include <atomic>
#include <cerrno>
#include <climits>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <string>

namespace {

std::string setting(const char* name) {
  const char* text = std::getenv(name);
  return text != nullptr ? text : "";
}

struct Refusal {
  std::string under = setting("REFUSE_UNDER"), counts = setting("REFUSE_COUNTS");
  long from = std::atol(setting("REFUSE_FROM").c_str());
  bool is_here = setting("REFUSE_RANK").empty() || setting("REFUSE_RANK") == setting("OMPI_COMM_WORLD_RANK");
  std::atomic<long> calls{0};

  /// Tells REFUSE_COUNTS of one more call, and gives its number.
  long count() {
    const long call = ++calls;
    std::FILE* file = counts.empty() ? nullptr : std::fopen(counts.c_str(), "a");
    if (file == nullptr) return call;
    std::fprintf(file, "%ld\n", call);
    std::fclose(file);
    return call;
  }
};

bool refused(int fd) {
  static Refusal refusal;
  if (!refusal.is_here || refusal.under.empty()) return false;
  std::array<char, PATH_MAX> path{};
  const ssize_t length =
      readlink(("/proc/self/fd/" + std::to_string(fd)).c_str(), path.data(), path.size() - 1);
  if (length < 0 || std::strncmp(path.data(), refusal.under.c_str(), refusal.under.size()) != 0) return false;
  const long call = refusal.count();
  if (refusal.from <= 0 || call < refusal.from) return false;
  errno = EDQUOT;
  return true;
}

/// The function of the next library with this name.
template <class Function>
Function next(const char* name) {
  return reinterpret_cast<Function>(dlsym(RTLD_NEXT, name));
}

template <class Result, class... Args>
Result call_or_refuse(const char* name, int fd, Args... args) {
  if (refused(fd)) return -1;
  return next<Result (*)(int, Args...)>(name)(fd, args...);
}

}  // namespace

extern "C" {
ssize_t write(int fd, const void* from, size_t size) {
  return call_or_refuse<ssize_t>("write", fd, from, size);
}
ssize_t writev(int fd, const iovec* parts, int count) {
  return call_or_refuse<ssize_t>("writev", fd, parts, count);
}
ssize_t pwrite(int fd, const void* from, size_t size, off_t at) {
  return call_or_refuse<ssize_t>("pwrite", fd, from, size, at);
}
ssize_t pwrite64(int fd, const void* from, size_t size, off64_t at) {
  return call_or_refuse<ssize_t>("pwrite64", fd, from, size, at);
}
ssize_t pwritev(int fd, const iovec* parts, int count, off_t at) {
  return call_or_refuse<ssize_t>("pwritev", fd, parts, count, at);
}
ssize_t pwritev64(int fd, const iovec* parts, int count, off64_t at) {
  return call_or_refuse<ssize_t>("pwritev64", fd, parts, count, at);
}
int ftruncate(int fd, off_t size) noexcept { return call_or_refuse<int>("ftruncate", fd, size); }
int ftruncate64(int fd, off64_t size) noexcept { return call_or_refuse<int>("ftruncate64", fd, size); }
int fallocate(int fd, int mode, off_t at, off_t size) {
  return call_or_refuse<int>("fallocate", fd, mode, at, size);
}
int fallocate64(int fd, int mode, off64_t at, off64_t size) {
  return call_or_refuse<int>("fallocate64", fd, mode, at, size);
}
int fsync(int fd) { return call_or_refuse<int>("fsync", fd); }
int fdatasync(int fd) { return call_or_refuse<int>("fdatasync", fd); }
}
