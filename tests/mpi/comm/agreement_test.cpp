#include "mpi/comm/agreement.h"

#include <gtest/gtest.h>

#include <stdexcept>
#include <string>

#include "core/error.h"

namespace pbmpi::mpi {
namespace {

/// The message of the error of type Error that `function` throws; the test fails if it throws none or another
/// type.
template <class Error, class Function>
std::string message_of(Function&& function) {
  try {
    function();
  } catch (const Error& error) {
    EXPECT_EQ(typeid(error), typeid(Error));
    return error.what();
  }
  ADD_FAILURE() << "no error";
  return "";
}

TEST(AgreeOnErrors, returns_what_the_function_returns) {
  const Communicator comm = Communicator::world();
  EXPECT_EQ(agree_on_errors(comm, [&] { return comm.rank() + 10; }), comm.rank() + 10);
  int calls = 0;
  agree_on_errors(comm, [&] { ++calls; });
  EXPECT_EQ(calls, 1);
}

TEST(AgreeOnErrors, throws_on_every_rank_what_one_rank_throws_and_names_it) {
  const Communicator comm = Communicator::world();
  const int culprit = comm.size() - 1;
  const std::string message = message_of<core::InputError>([&] {
    agree_on_errors(comm, [&] {
      if (comm.rank() == culprit) throw core::InputError("scene.toml: cannot be read");
      return 1;
    });
  });
  // With a single rank the error is everywhere, and no rank is named.
  const std::string prefix = comm.size() > 1 ? "rank " + std::to_string(culprit) + ": " : "";
  EXPECT_EQ(message, prefix + "scene.toml: cannot be read");
}

TEST(AgreeOnErrors, keeps_the_message_plain_when_every_rank_fails) {
  const Communicator comm = Communicator::world();
  const std::string message = message_of<core::RunError>([&] {
    agree_on_errors(comm, [&] { throw core::RunError("by rank " + std::to_string(comm.rank())); });
  });
  EXPECT_EQ(message, "by rank 0");
}

TEST(AgreeOnErrors, lets_the_lowest_failing_rank_decide) {
  const Communicator comm = Communicator::world();
  if (comm.size() < 3) GTEST_SKIP() << "needs three ranks";
  const std::string message = message_of<core::RunError>([&] {
    agree_on_errors(comm, [&] {
      if (comm.rank() == 1) throw core::RunError("first");
      if (comm.rank() == 2) throw core::InputError("second");
    });
  });
  EXPECT_EQ(message, "rank 1: first");
}

TEST(AgreeOnErrors, memory_that_one_rank_lacks_is_an_error_of_the_run) {
  const Communicator comm = Communicator::world();
  const std::string message = message_of<core::RunError>([&] {
    agree_on_errors(comm, [&] {
      if (comm.rank() == comm.size() - 1) throw std::bad_alloc();
    });
  });
  EXPECT_NE(message.find("not enough memory; ask for fewer"), std::string::npos);
}

TEST(AgreeOnErrors, passes_other_exceptions_on_as_runtime_error) {
  const Communicator comm = Communicator::world();
  EXPECT_EQ(message_of<std::runtime_error>(
                [&] { agree_on_errors(comm, [] { throw std::out_of_range("beyond"); }); }),
            "beyond");
  EXPECT_EQ(message_of<std::runtime_error>([&] { agree_on_errors(comm, [] { throw 42; }); }),
            "an exception of unknown type");
}

TEST(AgreeOnErrors, works_without_mpi) {
  EXPECT_EQ(message_of<core::InputError>(
                [] { agree_on_errors(Communicator(), [] { throw core::InputError("alone"); }); }),
            "alone");
}

TEST(ErrorHold, keeps_the_first_error) {
  ErrorHold hold;
  hold.guard([] {});
  EXPECT_FALSE(hold.failed());
  hold.guard([] { throw core::InputError("first"); });
  hold.guard([] { throw core::RunError("second"); });
  EXPECT_TRUE(hold.failed());
  EXPECT_EQ(hold.kind(), ErrorKind::input);
  EXPECT_EQ(hold.message(), "first");
}

}  // namespace
}  // namespace pbmpi::mpi
