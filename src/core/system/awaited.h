/// A watch over waits that may never end: what is waited for is said aloud, and the process does not wait for
/// ever.
#pragma once

#include <string>
#include <string_view>

namespace pbmpi::core {

/// While one lives, the main thread waits for `what`, e.g. "all ranks to create run.h5". From a first time
/// on, and each time the wait has doubled, a line on stderr names it; when the limit is over the process ends
/// with exit code 1. The innermost one counts. Uses SIGALRM; main thread only.
class Awaited {
 public:
  explicit Awaited(std::string_view what);
  ~Awaited();
  Awaited(const Awaited&) = delete;
  Awaited& operator=(const Awaited&) = delete;

 private:
  std::string outer_;
};

/// Who waits, e.g. "pbmpi: rank 3".
void set_waiter(std::string_view name);

/// The first line comes after half a minute, or a quarter of the limit if that is sooner. Until this is
/// called the limit is half an hour.
void set_wait_limit(int seconds);

/// The process ends by `signal` in so many seconds unless end_deadline() comes before; `what`, a string that
/// stays, says on stderr what did not happen. Takes the place of an Awaited. Async-signal-safe.
void begin_deadline(const char* what, unsigned seconds, int signal) noexcept;
void end_deadline() noexcept;

}  // namespace pbmpi::core
