#include "app/pbmpi/signals.h"

#include <csignal>

namespace pbmpi::app {
namespace {

// A signal handler can reach nothing but globals; these are the only ones.
std::atomic<int> stop_signal{0};
std::atomic<int> save_signals{0};
static_assert(std::atomic<int>::is_always_lock_free, "a signal handler may only touch a lock-free atomic");

extern "C" void remember_stop(int signal) { stop_signal.store(signal, std::memory_order_relaxed); }
extern "C" void count_save(int) { save_signals.fetch_add(1, std::memory_order_relaxed); }

void install(void (*on_stop)(int), void (*on_save)(int)) {
  struct sigaction action {};
  action.sa_handler = on_stop;
  action.sa_flags = SA_RESTART;
  sigemptyset(&action.sa_mask);
  sigaction(SIGINT, &action, nullptr);
  sigaction(SIGTERM, &action, nullptr);
  sigaction(SIGUSR2, &action, nullptr);
  action.sa_handler = on_save;
  sigaction(SIGUSR1, &action, nullptr);
}

}  // namespace

SignalRequests::SignalRequests() {
  stop_signal = 0;
  save_signals = 0;
  install(remember_stop, count_save);
}

SignalRequests::~SignalRequests() { install(SIG_DFL, SIG_DFL); }

const std::atomic<int>& SignalRequests::stop() const { return stop_signal; }
const std::atomic<int>& SignalRequests::saves() const { return save_signals; }

}  // namespace pbmpi::app
