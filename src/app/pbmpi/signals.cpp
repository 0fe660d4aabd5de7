#include "app/pbmpi/signals.h"

#include <csignal>

namespace pbmpi::app {
namespace {

// A signal handler can reach nothing but a global; this is the only one.
std::atomic<int> signal_received{0};
static_assert(std::atomic<int>::is_always_lock_free, "a signal handler may only touch a lock-free atomic");

extern "C" void remember_signal(int signal) { signal_received.store(signal, std::memory_order_relaxed); }

void install(void (*handler)(int)) {
  struct sigaction action {};
  action.sa_handler = handler;
  action.sa_flags = SA_RESTART;
  sigemptyset(&action.sa_mask);
  sigaction(SIGINT, &action, nullptr);
  sigaction(SIGTERM, &action, nullptr);
  sigaction(SIGUSR2, &action, nullptr);
}

}  // namespace

StopOnSignal::StopOnSignal() {
  signal_received = 0;
  install(remember_signal);
}

StopOnSignal::~StopOnSignal() { install(SIG_DFL); }

const std::atomic<int>& StopOnSignal::flag() const { return signal_received; }

}  // namespace pbmpi::app
