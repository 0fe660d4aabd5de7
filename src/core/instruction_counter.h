/// Counts the instructions of a piece of the program, where a counter is available.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

namespace pbmpi::core {

/// The counter. perf_event: the processor's, by Linux's perf_event_open; absent in most virtual machines, or
/// forbidden by kernel.perf_event_paranoid. callgrind: Valgrind's tool under which the program runs, with the
/// environment variable PBMPI_CALLGRIND_OUT naming its --callgrind-out-file.
enum class InstructionSource { none, perf_event, callgrind };
constexpr std::string_view name_of(InstructionSource source) {
  constexpr std::string_view names[] = {"none", "perf_event", "callgrind"};
  return names[static_cast<int>(source)];
}

/// Instructions of this thread in user space (callgrind: of all threads). One piece at a time.
class InstructionCounter {
 public:
  /// Takes callgrind if the program runs under it, otherwise the processor's counter, otherwise none.
  InstructionCounter();
  ~InstructionCounter();
  InstructionCounter(const InstructionCounter&) = delete;
  InstructionCounter& operator=(const InstructionCounter&) = delete;

  InstructionSource source() const { return source_; }
  bool available() const { return source_ != InstructionSource::none; }

  /// Does nothing without a counter.
  void start();
  /// Instructions since start(); -1 without a counter. Throws core::RunError if the counter cannot be read.
  std::int64_t stop();

 private:
  InstructionSource source_ = InstructionSource::none;
  int perf_file_ = -1;
  std::string dump_prefix_;  ///< callgrind writes PREFIX.1, PREFIX.2 ...
};

}  // namespace pbmpi::core
