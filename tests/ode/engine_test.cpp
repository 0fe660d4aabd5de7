#include "ode/objects/engine.h"

#include <gtest/gtest.h>

#include "core/error.h"
#include "ode/objects/handles.h"
#include "support/models.h"

namespace pbmpi::ode {
namespace {

class Recorder {
 public:
  MessageLog log{[this](const std::string& line) { lines.push_back(line); }};
  std::vector<std::string> lines;
};

TEST(Engine, may_be_started_more_than_once) {
  const Engine first;
  { const Engine second; }
  const WorldHandle world(dWorldCreate());
  EXPECT_EQ(dWorldStep(world.get(), 0.01), 1);  // ODE is still initialised
}

TEST(MessageScope, hands_on_the_first_of_each_message_and_counts_the_rest) {
  Recorder recorder;
  recorder.log.set_place(3, 17);
  {
    const MessageScope scope(recorder.log);
    for (int i = 0; i < 5; ++i) dMessage(1, "LCP internal error, s = %g", 0.5);
    dMessage(2, "something else");
  }
  ASSERT_EQ(recorder.lines.size(), 2u);
  EXPECT_EQ(recorder.lines[0], "ode: world 3, step 17: LCP internal error, s = 0.5");
  EXPECT_EQ(recorder.lines[1], "ode: world 3, step 17: something else");
  EXPECT_EQ(recorder.log.total(), 6);
  recorder.log.report_counts();
  ASSERT_EQ(recorder.lines.size(), 3u);
  EXPECT_EQ(recorder.lines[2], "ode: 5 messages like: LCP internal error, s = 0.5");
}

TEST(MessageScope, turns_errors_into_a_failed_run) {
  Recorder recorder;
  recorder.log.set_place(4, 9);
  const MessageScope scope(recorder.log);
  // Without the handlers the first call would exit and the second abort.
  EXPECT_THROW(dError(7, "bad matrix"), core::RunError);
  try {
    dDebug(8, "assertion %d", 12);
    FAIL() << "no error";
  } catch (const core::RunError& error) {
    EXPECT_STREQ(error.what(), "ode: world 4, step 9: error 8: assertion 12");
  }
}

TEST(MessageScope, nests_and_puts_the_handlers_back) {
  dMessageFunction* const before = dGetMessageHandler();
  Recorder outer, inner;
  {
    const MessageScope outer_scope(outer.log);
    {
      const MessageScope inner_scope(inner.log);
      dMessage(1, "inside");
    }
    dMessage(1, "outside");
  }
  EXPECT_EQ(inner.lines.size(), 1u);
  EXPECT_EQ(outer.lines.size(), 1u);
  EXPECT_EQ(dGetMessageHandler(), before);
}

}  // namespace
}  // namespace pbmpi::ode
