#include "io/hdf5/output_target.h"

#include <gtest/gtest.h>

#include <fstream>

#include "core/error.h"
#include "scratch.h"

namespace pbmpi::io::test {
namespace {

std::string refusal(const std::string& path, std::int64_t bytes = 1000) {
  try {
    OutputTarget target(path, bytes);
  } catch (const core::InputError& error) {
    return error.what();
  }
  return "created " + path;
}

void expect_refusal(const std::string& path, const std::string& reason, std::int64_t bytes = 1000) {
  const std::string message = refusal(path, bytes);
  EXPECT_NE(message.find(path), std::string::npos) << message;
  EXPECT_NE(message.find(reason), std::string::npos) << message;
}

TEST(OutputTarget, appears_under_its_name_only_when_published) {
  const Scratch scratch;
  OutputTarget target(scratch.file("run.h5"), 1000);
  EXPECT_FALSE(std::filesystem::exists(scratch.file("run.h5")));
  std::ofstream(target.temporary_path()) << "content";
  target.publish();
  EXPECT_EQ(std::filesystem::file_size(scratch.file("run.h5")), 7u);
  EXPECT_EQ(scratch.num_files(), 1u);
}

TEST(OutputTarget, leaves_nothing_behind_and_the_older_file_alone_if_it_is_not_published) {
  const Scratch scratch;
  std::ofstream(scratch.file("run.h5")) << "older";
  { const OutputTarget target(scratch.file("run.h5"), 1000); }
  EXPECT_EQ(std::filesystem::file_size(scratch.file("run.h5")), 5u);
  EXPECT_EQ(scratch.num_files(), 1u);
}

TEST(OutputTarget, refuses_what_it_cannot_create) {
  const Scratch scratch;
  expect_refusal(scratch.file("missing/run.h5"), "there is no directory");
  expect_refusal(scratch.folder().string(), "it is a directory");
  expect_refusal("/dev/null", "not a regular file");
  expect_refusal("/proc/run.h5", "cannot create");  // no one may create files there, not even root
  EXPECT_NE(refusal("").find("its name is empty"), std::string::npos);
  EXPECT_EQ(scratch.num_files(), 0u);
}

TEST(OutputTarget, refuses_more_than_the_disk_holds_and_leaves_nothing_behind) {
  const Scratch scratch;
  // 4 EiB, more than any file system here; some say "too large" before they look at what is free.
  const std::string message = refusal(scratch.file("run.h5"), std::int64_t{1} << 62);
  EXPECT_NE(message.find("do not fit"), std::string::npos) << message;
  EXPECT_EQ(scratch.num_files(), 0u);
}

}  // namespace
}  // namespace pbmpi::io::test
