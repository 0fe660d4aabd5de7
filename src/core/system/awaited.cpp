#include "core/system/awaited.h"

#include <time.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <csignal>
#include <cstring>

#include "core/error.h"
#include "core/system/leftovers.h"
#include "core/system/signal_handler.h"

namespace pbmpi::core {
namespace {

// SIGALRM's handler can reach only these globals. Code that changes them switches the alarm off first.
std::array<char, 80> waiter = {"this process"};
std::array<char, 400> awaited{};
unsigned limit_s = 1800;
time_t since_s = 0;
unsigned first_word_s = 0;   ///< after `since_s`; 0: none
unsigned next_notice_s = 0;  ///< after `since_s`
unsigned end_s = 0;          ///< after `since_s`
int end_signal = 0;          ///< 0: end with an exit code

time_t whole_now_s() noexcept {
  timespec now{};
  clock_gettime(CLOCK_MONOTONIC, &now);
  return now.tv_sec;
}

template <std::size_t size>
void copy_text(std::string_view text, std::array<char, size>& to) noexcept {
  const std::size_t length = std::min(text.size(), size - 1);
  std::memmove(to.data(), text.data(), length);
  to[length] = '\0';
}

/// A line of stderr, composed only with functions that a signal handler may call.
class Line {
 public:
  Line& operator<<(const char* text) noexcept {
    const std::size_t length = std::min(std::strlen(text), bytes_.size() - size_);
    std::memcpy(bytes_.data() + size_, text, length);
    size_ += length;
    return *this;
  }
  Line& operator<<(unsigned number) noexcept {
    std::array<char, 12> digits{};
    std::size_t begin = digits.size() - 1;
    do {
      digits[--begin] = static_cast<char>('0' + number % 10);
      number /= 10;
    } while (number > 0);
    return *this << (digits.data() + begin);
  }
  void print() const noexcept { static_cast<void>(!write(STDERR_FILENO, bytes_.data(), size_)); }

 private:
  std::array<char, 1024> bytes_{};
  std::size_t size_ = 0;
};

[[noreturn]] void give_up(unsigned waited_s) noexcept {
  Line line;
  line << waiter.data() << " waited " << waited_s << " s for " << awaited.data() << " and ends here\n";
  line.print();
  if (end_signal != 0) end_by_signal(end_signal);
  remove_leftovers();
  _exit(static_cast<int>(ExitCode::failed));
}

extern "C" void tell(int) {
  const auto waited_s = static_cast<unsigned>(whole_now_s() - since_s);
  if (waited_s >= end_s) give_up(waited_s);
  const bool is_early = first_word_s > 0 && waited_s < next_notice_s;
  if (is_early) {
    Line line;
    line << waiter.data() << " waits for " << awaited.data() << ": " << waited_s << " s so far\n";
    line.print();
  }
  if (waited_s >= next_notice_s) {
    Line line;
    line << waiter.data() << " has waited " << waited_s << " s for " << awaited.data()
         << "; another rank or the file system does not answer (the run ends after " << end_s << " s)\n";
    line.print();
    next_notice_s = 2 * waited_s;
  }
  alarm(std::max(std::min(next_notice_s, end_s) - waited_s, 1U));
}

/// The first alarm comes after `first_s`.
void switch_on(unsigned first_s) noexcept {
  handle_signal(SIGALRM, tell);
  alarm(first_s);
}

void begin_wait(std::string_view what) {
  constexpr unsigned usual_first_s = 30;
  copy_text(what, awaited);
  since_s = whole_now_s();
  end_s = limit_s;
  end_signal = 0;
  next_notice_s = std::clamp(limit_s / 4, 1U, usual_first_s);
  switch_on(first_word_s > 0 ? std::min(first_word_s, next_notice_s) : next_notice_s);
}

}  // namespace

Awaited::Awaited(std::string_view what) {
  alarm(0);
  outer_ = awaited.data();
  begin_wait(what);
}

Awaited::~Awaited() {
  alarm(0);
  awaited[0] = '\0';
  if (!outer_.empty()) begin_wait(outer_);
}

void set_waiter(std::string_view name) { copy_text(name, waiter); }

void set_first_word(int seconds) { first_word_s = static_cast<unsigned>(std::max(seconds, 0)); }

void set_wait_limit(int seconds) { limit_s = static_cast<unsigned>(std::max(seconds, 1)); }

void begin_deadline(const char* what, unsigned seconds, int signal) noexcept {
  alarm(0);
  copy_text(what, awaited);
  since_s = whole_now_s();
  end_s = next_notice_s = seconds;
  end_signal = signal;
  switch_on(seconds);
}

void end_deadline() noexcept {
  alarm(0);
  awaited[0] = '\0';
}

}  // namespace pbmpi::core
