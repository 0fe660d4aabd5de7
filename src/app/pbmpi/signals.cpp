#include "app/pbmpi/signals.h"

#include <time.h>
#include <unistd.h>

#include <algorithm>
#include <csignal>
#include <cstring>

#include "core/clock.h"
#include "core/system/awaited.h"
#include "core/system/leftovers.h"
#include "core/system/signal_handler.h"

namespace pbmpi::app {
namespace {

using Phase = SignalRequests::Phase;

constexpr unsigned least_grace_s = 10;

// A signal handler can reach only globals; these are the only ones.
std::atomic<int> stop_signal{0};
std::atomic<int> save_signals{0};
std::atomic<int> first_end_signal{0};  ///< INT or TERM
std::atomic<long> first_end_ms{0};
std::atomic<Phase> phase{Phase::set_up};
std::atomic<bool> speaking{false};
std::atomic<unsigned> grace_s{least_grace_s};
static_assert(std::atomic<int>::is_always_lock_free && std::atomic<long>::is_always_lock_free &&
                  std::atomic<Phase>::is_always_lock_free,
              "a signal handler may only touch a lock-free atomic");

long now_ms() {
  timespec now{};
  clock_gettime(CLOCK_MONOTONIC, &now);
  return 1000 * now.tv_sec + now.tv_nsec / 1000000;
}

/// Sets the deadline for the frame at whose end the run is to stop.
void begin_grace() {
  core::begin_deadline("its frame to end, after a signal to stop (what was committed is readable),", grace_s,
                       first_end_signal);
}

extern "C" void stop_after_frame(int signal) { stop_signal = signal; }
extern "C" void count_save(int) { ++save_signals; }

extern "C" void stop_or_end(int signal) {
  constexpr long same_ms = 100;
  if (phase == Phase::set_up) core::end_by_signal(signal);
  if (first_end_signal != 0) {
    if (now_ms() - first_end_ms > same_ms) core::end_by_signal(signal);
    return;
  }
  first_end_ms = now_ms();
  first_end_signal = signal;
  stop_signal = signal;
  if (phase == Phase::frames) begin_grace();
  if (!speaking) return;
  constexpr const char* heard =
      "pbmpi: the run ends after this frame; a second INT or TERM ends it at once\n";
  static_cast<void>(!write(STDERR_FILENO, heard, std::strlen(heard)));
}

void install(void (*on_end)(int), void (*on_stop)(int), void (*on_save)(int)) {
  core::handle_signal(SIGINT, on_end);
  core::handle_signal(SIGTERM, on_end);
  core::handle_signal(SIGUSR2, on_stop);
  core::handle_signal(SIGUSR1, on_save);
}

}  // namespace

SignalRequests::SignalRequests() {
  stop_signal = 0;
  save_signals = 0;
  first_end_signal = 0;
  phase = Phase::set_up;
  grace_s = least_grace_s;
  core::remove_leftovers_on_signals();
  install(stop_or_end, stop_after_frame, count_save);
}

SignalRequests::~SignalRequests() { install(SIG_DFL, SIG_DFL, SIG_DFL); }

void SignalRequests::enter(Phase entered, bool speaks) const {
  speaking = speaks;
  if (phase.exchange(entered) == Phase::frames) core::end_deadline();
  if (entered == Phase::frames && first_end_signal != 0) begin_grace();
}

const std::atomic<int>& SignalRequests::stop() const { return stop_signal; }
const std::atomic<int>& SignalRequests::saves() const { return save_signals; }

FrameWatch::FrameWatch() : last_s_(core::now_s()) {}

void FrameWatch::frame_done(const stepping::FrameRecord&) {
  const double now_s = core::now_s();
  constexpr double frames_to_wait = 3;
  grace_s = std::max(grace_s.load(), static_cast<unsigned>(frames_to_wait * (now_s - last_s_)));
  last_s_ = now_s;
  if (first_end_signal != 0) begin_grace();
}

void FrameWatch::secure() { core::end_deadline(); }

}  // namespace pbmpi::app
