#include "core/system/awaited.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <csignal>
#include <filesystem>
#include <fstream>

#include "core/system/leftovers.h"

namespace pbmpi::core {
namespace {

/// Returns only if nothing ends the process.
void sleep_in_vain() {
  constexpr int most_s = 60;
  for (int i = 0; i < 10 * most_s; ++i) usleep(100000);
}

TEST(AwaitedDeathTest, names_what_a_process_waits_for_and_ends_it_after_the_limit) {
  const auto wait = [] {
    set_waiter("pbmpi: rank 3");
    set_wait_limit(2);
    const Awaited awaited("all ranks to create run.h5");
    sleep_in_vain();
  };
  EXPECT_EXIT(wait(), testing::ExitedWithCode(1),
              "pbmpi: rank 3 has waited 1 s for all ranks to create run.h5; .*\n"
              "pbmpi: rank 3 waited 2 s for all ranks to create run.h5 and ends here");
}

TEST(AwaitedDeathTest, says_what_a_program_begins_with_before_anything_is_amiss) {
  const auto wait = [] {
    set_waiter("pbmpi: rank 0");
    set_wait_limit(12);
    set_first_word(1);
    const Awaited awaited("all ranks to read the scene");
    usleep(1500000);
    _exit(0);
  };
  EXPECT_EXIT(wait(), testing::ExitedWithCode(0),
              "^pbmpi: rank 0 waits for all ranks to read the scene: 1 s so far\n$");
}

TEST(AwaitedDeathTest, goes_on_with_the_outer_wait_when_the_inner_one_is_over) {
  const auto wait = [] {
    set_wait_limit(1);
    const Awaited outer("the outer one");
    { const Awaited inner("the inner one"); }
    sleep_in_vain();
  };
  EXPECT_EXIT(wait(), testing::ExitedWithCode(1), "for the outer one and ends here");
}

TEST(AwaitedDeathTest, leaves_a_process_alone_that_no_longer_waits) {
  const auto wait = [] {
    set_wait_limit(1);
    { const Awaited awaited("a moment"); }
    begin_deadline("another moment", 1, SIGTERM);
    end_deadline();
    usleep(1500000);
    _exit(0);
  };
  EXPECT_EXIT(wait(), testing::ExitedWithCode(0), "^$");
}

TEST(AwaitedDeathTest, ends_by_the_signal_of_a_deadline_that_is_over) {
  const auto wait = [] {
    begin_deadline("the frame to end", 1, SIGINT);
    sleep_in_vain();
  };
  EXPECT_EXIT(wait(), testing::KilledBySignal(SIGINT), "waited 1 s for the frame to end and ends here");
}

TEST(LeftoverDeathTest, goes_when_a_signal_ends_the_process) {
  const auto folder = std::filesystem::temp_directory_path() / ("pbmpi-leftover-" + std::to_string(getpid()));
  std::filesystem::create_directory(folder);
  const std::string gone = folder / "gone", kept = folder / "kept";
  for (const std::string& path : {gone, kept}) std::ofstream(path) << "content";
  const auto end = [&] {
    remove_leftovers_on_signals();
    { const Leftover forgotten(kept); }
    const Leftover leftover(gone);
    std::raise(SIGTERM);
  };
  EXPECT_EXIT(end(), testing::KilledBySignal(SIGTERM), "");
  EXPECT_FALSE(std::filesystem::exists(gone));
  EXPECT_TRUE(std::filesystem::exists(kept));
  std::filesystem::remove_all(folder);
}

}  // namespace
}  // namespace pbmpi::core
