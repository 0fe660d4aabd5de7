/// Counts the instructions of a piece of the program, where something can count them.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

namespace pbmpi::core {

/// What counts. perf_event: the processor, by Linux's perf_event_open; absent in most virtual machines, or
/// forbidden by kernel.perf_event_paranoid. callgrind: Valgrind's tool that the program runs under, with the
/// environment variable PBMPI_CALLGRIND_OUT naming its --callgrind-out-file.
enum class InstructionSource { none, perf_event, callgrind };
constexpr std::string_view name_of(InstructionSource source) {
  constexpr std::string_view names[] = {"none", "perf_event", "callgrind"};
  return names[static_cast<int>(source)];
}

/// Instructions of this thread in user space (callgrind: of all threads). One piece at a time.
class InstructionCounter {
 public:
  /// Takes callgrind if the program runs under it, else the processor's counter, else none.
  InstructionCounter();
  ~InstructionCounter();
  InstructionCounter(const InstructionCounter&) = delete;
  InstructionCounter& operator=(const InstructionCounter&) = delete;

  InstructionSource source() const { return source_; }
  bool available() const { return source_ != InstructionSource::none; }

  /// Nothing happens where nothing counts.
  void start();
  /// Instructions since start(); -1 where nothing counts. Throws core::RunError if what counted cannot be
  /// read.
  std::int64_t stop();

 private:
  InstructionSource source_ = InstructionSource::none;
  int perf_file_ = -1;
  std::string dump_prefix_;  ///< callgrind writes PREFIX.1, PREFIX.2 ...
};

}  // namespace pbmpi::core
