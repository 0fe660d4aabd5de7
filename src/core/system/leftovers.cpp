#include "core/system/leftovers.h"

#include <unistd.h>

#include <array>
#include <atomic>
#include <csignal>
#include <utility>

namespace pbmpi::core {
namespace {

constexpr std::size_t most_bytes = 4096;

// A signal handler can reach only globals.
struct Slot {
  std::atomic<bool> taken{false}, ready{false};
  std::array<char, most_bytes> path{};
};
std::array<Slot, 32> slots;
static_assert(std::atomic<bool>::is_always_lock_free, "a signal handler may only touch a lock-free atomic");

extern "C" void clean_and_end(int signal) { end_by_signal(signal); }

}  // namespace

Leftover::Leftover(const std::string& path) {
  if (path.size() >= most_bytes) return;
  for (std::size_t i = 0; i < slots.size(); ++i) {
    if (slots[i].taken.exchange(true)) continue;
    path.copy(slots[i].path.data(), path.size());
    slots[i].path[path.size()] = '\0';
    slots[i].ready = true;
    slot_ = static_cast<int>(i);
    return;
  }
}

Leftover::~Leftover() {
  if (slot_ < 0) return;
  slots[static_cast<std::size_t>(slot_)].ready = false;
  slots[static_cast<std::size_t>(slot_)].taken = false;
}

Leftover::Leftover(Leftover&& other) noexcept : slot_(std::exchange(other.slot_, -1)) {}

Leftover& Leftover::operator=(Leftover&& other) noexcept {
  std::swap(slot_, other.slot_);
  return *this;
}

void remove_leftovers() noexcept {
  for (Slot& slot : slots) {
    if (slot.ready.exchange(false)) unlink(slot.path.data());
  }
}

void end_by_signal(int signal) noexcept {
  remove_leftovers();
  struct sigaction action {};
  action.sa_handler = SIG_DFL;
  sigemptyset(&action.sa_mask);
  sigaction(signal, &action, nullptr);
  sigset_t own;
  sigemptyset(&own);
  sigaddset(&own, signal);
  sigprocmask(SIG_UNBLOCK, &own, nullptr);
  raise(signal);
  _exit(128 + signal);
}

void remove_leftovers_on_signals() {
  struct sigaction action {};
  action.sa_handler = clean_and_end;
  sigemptyset(&action.sa_mask);
  sigaction(SIGINT, &action, nullptr);
  sigaction(SIGTERM, &action, nullptr);
  struct sigaction before {};
  sigaction(SIGHUP, nullptr, &before);
  if (before.sa_handler != SIG_IGN) sigaction(SIGHUP, &action, nullptr);
}

}  // namespace pbmpi::core
