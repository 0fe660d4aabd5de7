#include "scenes/nearest.h"

#include <gtest/gtest.h>

namespace pbmpi::scenes {
namespace {

TEST(Nearest, puts_the_fewest_slips_first) {
  const std::vector<std::string> names = {"replicas", "frames", "frame"};
  EXPECT_EQ(nearest_names("frams", names), (std::vector<std::string>{"frames", "frame"}));
}

TEST(Nearest, takes_upper_and_lower_case_as_equal) {
  EXPECT_EQ(nearest_names("CRASHSK", {"CrashSk"}), std::vector<std::string>{"CrashSk"});
}

TEST(Nearest, suggests_nothing_for_a_word_of_other_letters) {
  EXPECT_TRUE(nearest_names("xyz", {"frames", "dt"}).empty());
}

TEST(Nearest, lists_what_is_known_when_nothing_is_near) {
  EXPECT_EQ(suggestion("xyzxyz", {"mu", "restitution"}), "; known: 'mu', 'restitution'");
  EXPECT_EQ(suggestion("mv", {"mu", "restitution"}), "; did you mean 'mu'?");
}

}  // namespace
}  // namespace pbmpi::scenes
