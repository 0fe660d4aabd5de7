#include "core/system/input_file.h"

#include <gtest/gtest.h>
#include <sys/stat.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>

#include "core/error.h"

namespace pbmpi::core {
namespace {

class InputFiles : public testing::Test {
 protected:
  InputFiles() { std::filesystem::create_directories(folder_); }
  ~InputFiles() override { std::filesystem::remove_all(folder_); }

  std::string path(const std::string& name) const { return folder_ / name; }
  std::string refusal(const std::string& name, std::size_t most_bytes = 1000) const {
    try {
      read_input_file(path(name), "give a file", most_bytes);
    } catch (const InputError& error) {
      return error.what();
    }
    return "";
  }

 private:
  std::filesystem::path folder_ =
      std::filesystem::path(testing::TempDir()) / ("input_file_test_" + std::to_string(getpid()));
};

TEST_F(InputFiles, a_file_is_read_whole_also_through_a_link) {
  const std::string bytes("a\0b\n", 4);
  std::ofstream(path("file"), std::ios::binary) << bytes;
  std::filesystem::create_symlink(path("file"), path("link"));
  EXPECT_EQ(read_input_file(path("file"), ""), bytes);
  EXPECT_EQ(read_input_file(path("link"), ""), bytes);
}

TEST_F(InputFiles, pipes_devices_and_folders_are_refused_without_waiting) {
  ASSERT_EQ(mkfifo(path("pipe").c_str(), 0600), 0);
  std::filesystem::create_symlink("/dev/zero", path("zero"));
  EXPECT_EQ(refusal("pipe"),
            path("pipe") + ": cannot be read: it is a pipe or a device and no regular file; give a file");
  EXPECT_NE(refusal("zero").find("a pipe or a device"), std::string::npos);
  EXPECT_NE(refusal("").find("it is a directory"), std::string::npos);
  EXPECT_NE(refusal("absent").find("there is no such file"), std::string::npos);
}

TEST_F(InputFiles, a_file_beyond_the_limit_is_refused_before_it_is_read) {
  std::ofstream(path("large")) << "";
  std::filesystem::resize_file(path("large"), std::uintmax_t{1} << 40);
  EXPECT_NE(refusal("large").find("1048576 MiB"), std::string::npos);
}

}  // namespace
}  // namespace pbmpi::core
