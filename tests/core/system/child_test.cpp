#include "core/system/child.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <sstream>

namespace pbmpi::core {
namespace {

class Children : public testing::Test {
 protected:
  void SetUp() override {
    std::string path = (std::filesystem::temp_directory_path() / "pbmpi-child-XXXXXX").string();
    ASSERT_NE(mkdtemp(path.data()), nullptr);
    folder_ = path;
  }
  void TearDown() override { std::filesystem::remove_all(folder_); }

  ChildEnd run(const std::string& script, double limit_s = 60) {
    return run_child(
        {{"sh", "-c", script}, {{"PBMPI_WORD", "given"}}, folder_ / "out", folder_ / "err", limit_s});
  }
  std::string read(const char* name) const {
    std::ostringstream text;
    text << std::ifstream(folder_ / name).rdbuf();
    return text.str();
  }

  std::filesystem::path folder_;
};

TEST_F(Children, what_they_print_is_in_the_files) {
  EXPECT_EQ(run("echo good; echo bad >&2").exit_code, 0);
  EXPECT_EQ(read("out"), "good\n");
  EXPECT_EQ(read("err"), "bad\n");
}

TEST_F(Children, their_exit_code_is_that_of_a_shell) {
  EXPECT_EQ(run("exit 7").exit_code, 7);
  EXPECT_EQ(run("kill -TERM $$").exit_code, 128 + 15);
}

TEST_F(Children, a_program_that_does_not_exist_gives_127) {
  EXPECT_EQ(run_child({{"/no/such/program"}, {}, folder_ / "out", folder_ / "err", 60}).exit_code, 127);
}

TEST_F(Children, they_get_the_environment_but_not_what_mpirun_has_set) {
  setenv("OMPI_COMM_WORLD_RANK", "3", 1);
  setenv("PMIX_RANK", "3", 1);
  setenv("PBMPI_WORD", "own", 1);
  setenv("PBMPI_OTHER", "kept", 1);
  run("echo $PBMPI_WORD $PBMPI_OTHER; env | grep -E '^(OMPI|PMIX)_' | wc -l");
  EXPECT_EQ(read("out"), "given kept\n0\n");
  for (const char* name : {"OMPI_COMM_WORLD_RANK", "PMIX_RANK", "PBMPI_WORD", "PBMPI_OTHER"}) unsetenv(name);
}

TEST_F(Children, they_end_at_the_limit) {
  const ChildEnd end = run("exec sleep 100", 0.2);
  EXPECT_TRUE(end.timed_out);
  EXPECT_EQ(end.exit_code, 128 + 9);
}

TEST(Program, knows_the_folder_of_its_file) {
  EXPECT_TRUE(std::filesystem::exists(folder_of_program() + "/core_system_test"));
}

}  // namespace
}  // namespace pbmpi::core
