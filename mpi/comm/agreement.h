/// One error for all ranks: an error on one rank must not leave the others waiting.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <type_traits>
#include <utility>

#include "mpi/comm/communicator.h"

namespace pbmpi::mpi {

/// Message for std::bad_alloc, which becomes a core::RunError when it is an error of all ranks.
inline constexpr const char* out_of_memory =
    "there is not enough memory; ask for fewer worlds, frames or bodies, or use more nodes";

/// The class of an error, which decides what is thrown again on the other ranks.
enum class ErrorKind : std::int8_t {
  none,
  input,  ///< core::InputError
  run,    ///< core::RunError
  other,  ///< anything else; thrown again as std::runtime_error
};

/// Keeps the first error of this rank until the ranks next agree on errors.
class ErrorHold {
 public:
  /// Calls `function` and keeps what it throws, unless an earlier error is already held.
  template <class Function>
  void guard(Function&& function) {
    try {
      std::forward<Function>(function)();
    } catch (...) {
      keep_current();
    }
  }

  bool failed() const { return kind_ != ErrorKind::none; }
  ErrorKind kind() const { return kind_; }
  const std::string& message() const { return message_; }

 private:
  void keep_current();

  ErrorKind kind_ = ErrorKind::none;
  std::string message_;
};

/// Collective. Throws on every rank the error that rank `source` holds. Its message begins with "rank N: "
/// unless the error is `everywhere`.
[[noreturn]] void throw_error_of(const Communicator& comm, const ErrorHold& mine, int source,
                                 bool everywhere);

/// Collective. If any rank holds an error, throws that of the lowest such rank on every rank.
void agree(const Communicator& comm, const ErrorHold& mine);

/// Collective. Calls `function` on every rank and returns what it returns; if it throws on any rank, every
/// rank throws the same error (see agree). `function` may communicate only if it cannot throw on one rank
/// alone before it does.
template <class Function>
auto agree_on_errors(const Communicator& comm, Function&& function) {
  using Result = std::invoke_result_t<Function>;
  ErrorHold hold;
  if constexpr (std::is_void_v<Result>) {
    hold.guard(std::forward<Function>(function));
    agree(comm, hold);
  } else {
    std::optional<Result> result;
    hold.guard([&] { result.emplace(std::forward<Function>(function)()); });
    agree(comm, hold);
    return std::move(*result);
  }
}

}  // namespace pbmpi::mpi
