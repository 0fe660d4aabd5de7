#include "app/common/progress_line.h"

#include <gtest/gtest.h>

#include <sstream>

namespace pbmpi::app {
namespace {

TEST(ProgressLine, writes_over_all_of_a_longer_text_and_ends_its_line) {
  std::ostringstream out;
  {
    ProgressLine line(out);
    line.show(true, [] { return std::string("abcd"); });
    line.show(true, [] { return std::string("xy"); });
  }
  EXPECT_EQ(out.str(), "\rabcd\rxy  \n");
}

TEST(ProgressLine, leaves_no_empty_line_if_nothing_was_drawn) {
  std::ostringstream out;
  { const ProgressLine line(out); }
  EXPECT_EQ(out.str(), "");
}

TEST(Progress, is_drawn_if_asked_for_however_quiet_the_program_is) {
  EXPECT_TRUE(wants_progress({.quiet = true, .progress = ProgressMode::always}));
  EXPECT_FALSE(wants_progress({.quiet = false, .progress = ProgressMode::never}));
  EXPECT_FALSE(wants_progress({.quiet = true, .progress = ProgressMode::automatic}));
}

}  // namespace
}  // namespace pbmpi::app
