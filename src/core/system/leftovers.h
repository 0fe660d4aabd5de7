/// Temporary files of a process, which are removed when a signal ends it.
#pragma once

#include <string>

namespace pbmpi::core {

/// While an object of this class lives, `path` is removed if a signal ends the process through
/// end_by_signal(). More than 32 files, and names of 4 KiB, are not noted. The destructor forgets the file
/// and leaves it where it is.
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

/// Removes all noted files. Async-signal-safe.
void remove_leftovers() noexcept;

/// Removes the leftovers, and ends the process by `signal` as if nothing had caught it. Async-signal-safe.
[[noreturn]] void end_by_signal(int signal) noexcept;

/// From now on INT, TERM and HUP end this process through end_by_signal(), except HUP where it is ignored
/// (nohup).
void remove_leftovers_on_signals();

}  // namespace pbmpi::core
