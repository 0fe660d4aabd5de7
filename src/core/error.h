/// Errors that end a program, and their exit codes.
#pragma once

#include <stdexcept>
#include <string>

namespace pbmpi::core {

/// Exit codes of the three programs (also in --help).
enum class ExitCode : int { done = 0, failed = 1, bad_input = 2, stopped = 75 };

/// The user can correct this: bad usage, a malformed file, an impossible value. Exit code 2.
/// Message grammar: *where: what is wrong (why it is one); what to do*.
class InputError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// The run itself failed: a non-finite state, a full disk, a lost rank. Exit code 1.
class RunError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// Throws InputError(message) unless `condition` holds.
void require_input(bool condition, const std::string& message);

/// Throws std::logic_error with the place of the call unless `condition` holds: an error in this program,
/// never the user's.
void require_invariant(bool condition, const char* what);

}  // namespace pbmpi::core
