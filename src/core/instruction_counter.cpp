#include "core/instruction_counter.h"

#include <linux/perf_event.h>
#include <sys/ioctl.h>
#include <sys/syscall.h>
#include <unistd.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>

#include "core/error.h"

#if PBMPI_HAS_CALLGRIND
#include <valgrind/callgrind.h>
#else  // without Valgrind's header the program cannot ask the tool for its count
#define RUNNING_ON_VALGRIND 0
#define CALLGRIND_ZERO_STATS
#define CALLGRIND_DUMP_STATS
#endif

namespace pbmpi::core {
namespace {

/// A file descriptor, or -1.
int open_perf_event() {
  perf_event_attr what{};
  what.type = PERF_TYPE_HARDWARE;
  what.size = sizeof what;
  what.config = PERF_COUNT_HW_INSTRUCTIONS;
  what.disabled = 1;
  what.exclude_kernel = 1;
  what.exclude_hv = 1;
  return static_cast<int>(syscall(SYS_perf_event_open, &what, 0, -1, -1, 0));
}

/// The number after "totals: " in the only dump that starts with `prefix`, which is then removed, so that the
/// next dump is again the only one.
std::int64_t take_dump(const std::string& prefix) {
  const std::filesystem::path path(prefix);
  const std::string start = path.filename().string() + ".";
  for (const auto& entry : std::filesystem::directory_iterator(path.parent_path())) {
    if (!entry.path().filename().string().starts_with(start)) continue;
    std::ifstream file(entry.path());
    for (std::string line; std::getline(file, line);) {
      if (!line.starts_with("totals: ")) continue;
      std::filesystem::remove(entry.path());
      return std::stoll(line.substr(8));
    }
  }
  throw RunError(prefix +
                 ": callgrind has written no count beside it; PBMPI_CALLGRIND_OUT must be what "
                 "--callgrind-out-file is");
}

}  // namespace

InstructionCounter::InstructionCounter() {
  const char* prefix = std::getenv("PBMPI_CALLGRIND_OUT");
  if (RUNNING_ON_VALGRIND) {
    if (prefix == nullptr) return;
    dump_prefix_ = std::filesystem::absolute(prefix).string();
    for (std::size_t at; (at = dump_prefix_.find("%p")) != std::string::npos;) {
      dump_prefix_.replace(at, 2, std::to_string(getpid()));
    }
    source_ = InstructionSource::callgrind;
    return;
  }
  perf_file_ = open_perf_event();
  if (perf_file_ < 0) return;
  source_ = InstructionSource::perf_event;
  start();
  if (stop() == 0)
    source_ = InstructionSource::none;  // some virtual machines open a counter that stands still
}

InstructionCounter::~InstructionCounter() {
  if (perf_file_ >= 0) close(perf_file_);
}

void InstructionCounter::start() {
  if (source_ == InstructionSource::callgrind) {
    CALLGRIND_ZERO_STATS;
  } else if (source_ == InstructionSource::perf_event) {
    ioctl(perf_file_, PERF_EVENT_IOC_RESET, 0);
    ioctl(perf_file_, PERF_EVENT_IOC_ENABLE, 0);
  }
}

std::int64_t InstructionCounter::stop() {
  if (source_ == InstructionSource::callgrind) {
    CALLGRIND_DUMP_STATS;
    return take_dump(dump_prefix_);
  }
  if (source_ == InstructionSource::none) return -1;
  ioctl(perf_file_, PERF_EVENT_IOC_DISABLE, 0);
  std::int64_t count = 0;
  if (read(perf_file_, &count, sizeof count) != static_cast<ssize_t>(sizeof count))
    throw RunError("the processor's counter of instructions cannot be read");
  return count;
}

}  // namespace pbmpi::core
