/// Files that a process makes for itself alone, and that go when a signal ends it.
#pragma once

#include <string>

namespace pbmpi::core {

/// While one lives, `path` is removed if a signal ends the process by way of end_by_signal(). Beyond 32 of
/// them, and for names of 4 KiB, nothing is noted. The destructor forgets the file and leaves it where it is.
class Leftover {
 public:
  Leftover() = default;
  explicit Leftover(const std::string& path);
  ~Leftover();
  Leftover(Leftover&& other) noexcept;
  Leftover& operator=(Leftover&& other) noexcept;

 private:
  int slot_ = -1;
};

/// Removes all that are noted. Async-signal-safe.
void remove_leftovers() noexcept;

/// Removes what is left over, and ends the process by `signal` as if nobody had caught it. Async-signal-safe.
[[noreturn]] void end_by_signal(int signal) noexcept;

/// From now on INT, TERM and HUP end this process by way of end_by_signal(); HUP not where it is ignored
/// (nohup).
void remove_leftovers_on_signals();

}  // namespace pbmpi::core
