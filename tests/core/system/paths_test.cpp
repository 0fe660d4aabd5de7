#include "core/system/paths.h"

#include <gtest/gtest.h>

#include <string>

namespace pbmpi::core {
namespace {

TEST(Paths, of_one_place_mean_one_file_though_nothing_is_there) {
  EXPECT_TRUE(is_same_file("run.h5", "./run.h5"));
  EXPECT_TRUE(is_same_file("folder/../run.h5", "run.h5"));
  EXPECT_FALSE(is_same_file("run.h5", "other.h5"));
  EXPECT_FALSE(is_same_file("folder/run.h5", "run.h5"));
}

TEST(Paths, that_no_file_system_takes_are_told_apart) {
  const std::string long_name(300, 'a');
  EXPECT_FALSE(is_same_file(long_name + ".h5", long_name + ".checkpoint.h5"));
  EXPECT_TRUE(is_same_file(long_name, "./" + long_name));
}

TEST(Paths, of_streams_are_never_one_file) { EXPECT_FALSE(is_same_file("/dev/null", "/dev/null")); }

}  // namespace
}  // namespace pbmpi::core
