#include "app/pbstudy/study/stop_request.h"

#include <atomic>
#include <csignal>

namespace pbmpi::app {
namespace {

std::atomic<bool> stop_requested{false};  // a signal handler can reach nothing but globals
static_assert(std::atomic<bool>::is_always_lock_free);

extern "C" void request_stop(int) { stop_requested = true; }

void install(void (*handler)(int)) {
  struct sigaction action {};
  action.sa_handler = handler;
  action.sa_flags = SA_RESTART;
  sigfillset(&action.sa_mask);
  sigaction(SIGUSR2, &action, nullptr);
}

}  // namespace

StopRequest::StopRequest() {
  stop_requested = false;
  install(request_stop);
}

StopRequest::~StopRequest() { install(SIG_DFL); }

bool StopRequest::is_set() const { return stop_requested; }

}  // namespace pbmpi::app
