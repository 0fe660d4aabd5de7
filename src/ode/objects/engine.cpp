#include "ode/objects/engine.h"

#include <array>
#include <cstdio>

#include "ode/objects/handles.h"

namespace pbmpi::ode {
namespace {

thread_local MessageLog* active_log = nullptr;

std::string format(const char* message, std::va_list arguments) {
  std::array<char, 512> text{};
  std::vsnprintf(text.data(), text.size(), message, arguments);
  return text.data();
}

void on_message(int number, const char* message, std::va_list arguments) {
  active_log->record(number, format(message, arguments));
}

/// ODE ends the process if this returns, so it must throw.
[[noreturn]] void on_error(int number, const char* message, std::va_list arguments) {
  throw EngineError("ode: " + active_log->place() + ": error " + std::to_string(number) + ": " +
                    format(message, arguments));
}

}  // namespace

void MessageLog::set_place(int world, std::int64_t step) {
  world_ = world;
  step_ = step;
}

void MessageLog::record(int number, const std::string& text) {
  Seen& seen = seen_[number];
  if (seen.count++ > 0) return;
  seen.text = text;
  warn(text);
}

void MessageLog::report_counts() const {
  for (const auto& [number, seen] : seen_) {
    if (seen.count > 1) warn_("ode: " + std::to_string(seen.count) + " messages like: " + seen.text);
  }
}

std::string MessageLog::place() const {
  return "world " + std::to_string(world_) + ", step " + std::to_string(step_);
}

std::int64_t MessageLog::total() const {
  std::int64_t sum = 0;
  for (const auto& entry : seen_) sum += entry.second.count;
  return sum;
}

Engine::Engine() {
  if (dInitODE2(0) == 0) throw core::RunError("ode: dInitODE2 failed");
  const std::string precision = is_single_precision ? "single" : "double";
  if (dAllocateODEDataForThread(dAllocateMaskAll) == 0 ||
      dCheckConfiguration(("ODE_" + precision + "_precision").c_str()) == 0) {
    const std::string build = dGetConfiguration();
    dCloseODE();
    throw core::RunError(
        "ode: the library found at run time is not a " + precision + "-precision build (" + build + "); " +
        (is_single_precision ? "build with jobs/ode_single.sh again" : "install Debian's libode8"));
  }
}

void prepare_thread() {
  if (dAllocateODEDataForThread(dAllocateMaskAll) == 0)
    throw core::RunError("ode: dAllocateODEDataForThread failed");
}

Engine::~Engine() { dCloseODE(); }

MessageScope::MessageScope(MessageLog& log)
    : outer_log_(active_log),
      message_(dGetMessageHandler()),
      error_(dGetErrorHandler()),
      debug_(dGetDebugHandler()) {
  active_log = &log;
  dSetMessageHandler(on_message);
  dSetErrorHandler(on_error);
  dSetDebugHandler(on_error);
}

MessageScope::~MessageScope() {
  dSetMessageHandler(message_);
  dSetErrorHandler(error_);
  dSetDebugHandler(debug_);
  active_log = outer_log_;
}

}  // namespace pbmpi::ode
