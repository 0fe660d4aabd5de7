/// What a process does when it gets a signal.
#pragma once

#include <csignal>

namespace pbmpi::core {

/// From now on `handler` is called for `signal`, or SIG_DFL's default holds. No other signal comes between,
/// and system calls go on afterwards.
inline void handle_signal(int signal, void (*handler)(int)) noexcept {
  struct sigaction action {};
  action.sa_handler = handler;
  action.sa_flags = SA_RESTART;
  sigfillset(&action.sa_mask);
  sigaction(signal, &action, nullptr);
}

}  // namespace pbmpi::core
