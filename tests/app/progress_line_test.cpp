#include "app/common/progress_line.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <sstream>

namespace pbmpi::app {
namespace {

TEST(ProgressLine, writes_over_all_of_a_longer_text_and_ends_its_line) {
  std::ostringstream out;
  {
    ProgressLine line(out, ProgressForm::bar);
    line.show(true, [] { return std::string("abcd"); });
    line.show(true, [] { return std::string("xy"); });
  }
  EXPECT_EQ(out.str(), "\rabcd\rxy  \n");
}

TEST(ProgressLine, leaves_no_empty_line_if_nothing_was_drawn) {
  std::ostringstream out;
  { const ProgressLine line(out, ProgressForm::bar); }
  EXPECT_EQ(out.str(), "");
}

TEST(ProgressLine, is_a_line_now_and_then_where_nothing_can_be_redrawn) {
  std::ostringstream out;
  {
    ProgressLine at_once(out, ProgressForm::lines, 0);
    at_once.show(false, [] { return std::string("abcd"); });
    at_once.show(true, [] { return std::string("xy"); });
    ProgressLine later(out, ProgressForm::lines);
    later.show(true, [] { return std::string("not before ten seconds"); });
  }
  EXPECT_EQ(out.str(), "abcd\nxy\n");
}

TEST(Progress, of_a_pipe_comes_in_lines) {
  int ends[2];
  ASSERT_EQ(pipe(ends), 0);
  const int terminal = dup(STDERR_FILENO);
  dup2(ends[1], STDERR_FILENO);
  const ProgressForm form = progress_form({});
  dup2(terminal, STDERR_FILENO);
  for (const int end : {ends[0], ends[1], terminal}) close(end);
  EXPECT_EQ(form, ProgressForm::lines);
}

TEST(Progress, is_drawn_if_asked_for_however_quiet_the_program_is) {
  EXPECT_EQ(progress_form({.quiet = true, .progress = ProgressMode::always}), ProgressForm::bar);
  EXPECT_EQ(progress_form({.quiet = false, .progress = ProgressMode::never}), ProgressForm::none);
  EXPECT_EQ(progress_form({.quiet = true, .progress = ProgressMode::automatic}), ProgressForm::none);
}

}  // namespace
}  // namespace pbmpi::app
