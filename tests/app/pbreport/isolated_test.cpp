#include "app/pbreport/isolated.h"

#include <gtest/gtest.h>
#include <signal.h>

namespace pbmpi::app {
namespace {

TEST(Isolated, a_crash_is_bad_input_and_everything_else_is_what_it_is) {
  EXPECT_EQ(run_isolated([] { return 0; }), 0);
  EXPECT_EQ(run_isolated([] { return 7; }), 7);
  for (const int crash : {SIGSEGV, SIGABRT, SIGBUS}) {
    EXPECT_EQ(run_isolated([crash] {
                signal(crash, SIG_DFL);
                raise(crash);
                return 0;
              }),
              2)
        << crash;
  }
}

}  // namespace
}  // namespace pbmpi::app
