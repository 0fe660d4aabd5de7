#include "core/error.h"

#include <gtest/gtest.h>

namespace pbmpi::core {
namespace {

TEST(Error, of_input_carries_its_message) {
  EXPECT_NO_THROW(require_input(true, "unused"));
  try {
    require_input(false, "dt: -1 is no time step; give seconds above 0");
    FAIL() << "no error";
  } catch (const InputError& error) {
    EXPECT_STREQ(error.what(), "dt: -1 is no time step; give seconds above 0");
  }
}

TEST(Error, of_ours_is_neither_the_users_nor_the_runs) {
  EXPECT_NO_THROW(require_invariant(true, "unused"));
  try {
    require_invariant(false, "a step went backwards");
    FAIL() << "no error";
  } catch (const std::logic_error& error) {
    EXPECT_STREQ(error.what(), "internal error: a step went backwards");
  }
}

}  // namespace
}  // namespace pbmpi::core
