/// Starts and ends ODE in this process, and handles its messages in between.
#pragma once

#include <cstdarg>
#include <cstdint>
#include <map>
#include <string>

#include "core/error.h"
#include "ode/objects/warning_sink.h"

namespace pbmpi::ode {

/// ODE found what it considers an internal error, e.g. a quaternion that is not a number.
class EngineError : public core::RunError {
 public:
  using core::RunError::RunError;
};

/// Collects ODE's messages ("LCP internal error ..."), which ODE would print on standard error.
class MessageLog {
 public:
  explicit MessageLog(WarningSink warn) : warn_(std::move(warn)) {}

  /// Sets the world and step of the messages that follow.
  void set_place(int world, std::int64_t step);
  /// Counts a message, and passes the first one of its number to the sink.
  void record(int number, const std::string& text);
  /// Passes a line to the sink, preceded by the place.
  void warn(const std::string& text) const { warn_("ode: " + place() + ": " + text); }
  /// Passes to the sink how often each message came, if more than once.
  void report_counts() const;
  /// "world 3, step 17".
  std::string place() const;
  std::int64_t total() const;

 private:
  struct Seen {
    std::string text;  ///< of the first message
    std::int64_t count = 0;
  };
  WarningSink warn_;
  int world_ = -1;
  std::int64_t step_ = 0;
  std::map<int, Seen> seen_;
};

/// Keeps ODE initialised while it lives. ODE counts its initialisations itself (dInitODE2 and dCloseODE come
/// in pairs), so each stepper owns one Engine.
class Engine {
 public:
  Engine();
  ~Engine();
  Engine(const Engine&) = delete;
  Engine& operator=(const Engine&) = delete;
};

/// Gives this thread the data that ODE needs to detect collisions in it, while an Engine lives; costs next to
/// nothing where the thread already has them. Throws core::RunError if there is no memory for them.
void prepare_thread();

/// Sends ODE's messages to `log` while it lives, and turns its errors into EngineError. Scopes nest; the
/// previous handlers are restored.
///
/// ODE's handlers are bare functions without user data, so the log of the innermost scope has to be reachable
/// from a thread-local variable: the only such variable of this library.
class MessageScope {
 public:
  explicit MessageScope(MessageLog& log);
  ~MessageScope();
  MessageScope(const MessageScope&) = delete;
  MessageScope& operator=(const MessageScope&) = delete;

 private:
  using Handler = void (*)(int, const char*, std::va_list);
  MessageLog* outer_log_;
  Handler message_, error_, debug_;
};

}  // namespace pbmpi::ode
