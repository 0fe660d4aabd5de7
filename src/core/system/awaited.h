/// Watches waits that may never end: reports on stderr what the process waits for, and ends the process
/// instead of letting it wait for ever.
#pragma once

#include <string>
#include <string_view>

namespace pbmpi::core {

/// While an object of this class lives, the main thread waits for `what`, e.g. "all ranks to create run.h5".
/// From a first time on, and each time the wait has doubled, a line on stderr names it; when the limit is
/// over the process ends with exit code 1. The innermost object counts. Uses SIGALRM; main thread only.
class Awaited {
 public:
  explicit Awaited(std::string_view what);
  ~Awaited();
  Awaited(const Awaited&) = delete;
  Awaited& operator=(const Awaited&) = delete;

 private:
  std::string outer_;
};

/// The name of this process in these lines, e.g. "pbmpi: rank 3".
void set_waiter(std::string_view name);

/// The first line comes after half a minute, or a quarter of the limit if that is sooner. The default limit
/// is half an hour.
void set_wait_limit(int seconds);

/// From now on the first line comes after `seconds`, and says only what the wait is for: the user of a
/// program that begins slowly then knows what it does. 0: it comes with the other lines.
void set_first_word(int seconds);

/// Ends the process by `signal` after `seconds` unless end_deadline() is called before; `what`, a string that
/// stays valid, is named on stderr as what did not happen. Replaces an Awaited. Async-signal-safe.
void begin_deadline(const char* what, unsigned seconds, int signal) noexcept;
void end_deadline() noexcept;

}  // namespace pbmpi::core
