#include "io/file/output_target.h"

#include <gtest/gtest.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>
#include <filesystem>
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
  {
    OutputTarget target(scratch.file("run.h5"), 1000);
    EXPECT_FALSE(std::filesystem::exists(scratch.file("run.h5")));
    std::ofstream(target.temporary_path()) << "content";
    target.publish();
  }
  EXPECT_EQ(std::filesystem::file_size(scratch.file("run.h5")), 7u);
  EXPECT_EQ(scratch.num_files(), 1u);
}

TEST(OutputTarget, leaves_nothing_behind_and_the_older_file_alone_if_it_is_not_published) {
  const Scratch scratch;
  std::ofstream(scratch.file("run.h5")) << "\x89HDF\r\n\x1a\n";
  { const OutputTarget target(scratch.file("run.h5"), 1000); }
  EXPECT_EQ(std::filesystem::file_size(scratch.file("run.h5")), 8u);
  EXPECT_EQ(scratch.num_files(), 1u);
}

TEST(OutputTarget, refuses_what_it_cannot_create) {
  const Scratch scratch;
  expect_refusal(scratch.file("missing/run.h5"), "there is no directory");
  expect_refusal(scratch.folder().string(), "it is a directory");
  expect_refusal("/dev/null", "not a regular file");
  expect_refusal("/proc/run.h5", "cannot create");  // nobody may create files there, not even root
  EXPECT_NE(refusal("").find("its name is empty"), std::string::npos);
  EXPECT_EQ(scratch.num_files(), 0u);
}

TEST(OutputTarget, replaces_no_file_that_is_not_hdf5) {
  const Scratch scratch;
  std::ofstream(scratch.file("scene.toml")) << "title = 1";
  expect_refusal(scratch.file("scene.toml"), "no HDF5 file");
  std::ofstream(scratch.file("empty"));
  EXPECT_NO_THROW(OutputTarget(scratch.file("empty"), 1000));
}

TEST(OutputTarget, keeps_the_file_that_it_published_apart_from_one_that_took_its_place) {
  const Scratch scratch;
  OutputTarget target(scratch.file("run.h5"), 1000);
  std::ofstream(target.temporary_path()) << "content";
  target.publish();
  EXPECT_NO_THROW(target.require_in_place());
  std::filesystem::rename(scratch.file("run.h5"), scratch.file("moved.h5"));
  std::ofstream(scratch.file("run.h5")) << "another";
  EXPECT_THROW(target.require_in_place(), core::RunError);
  EXPECT_TRUE(std::filesystem::equivalent(target.open_path(), scratch.file("moved.h5")));
}

std::string lock_refusal(const std::string& path, bool has_locks) {
  try {
    const OutputLock lock(path, has_locks);
  } catch (const core::InputError& error) {
    return error.what();
  }
  return "locked";
}

TEST(OutputLock, lets_one_write_a_file_by_whatever_name) {
  for (const bool has_locks : {true, false}) {
    const Scratch scratch;
    std::filesystem::create_symlink("run.h5", scratch.file("link.h5"));
    {
      const OutputLock lock(scratch.file("run.h5"), has_locks);
      for (const char* name : {"run.h5", "link.h5", "./run.h5"}) {
        const std::string message = lock_refusal(scratch.file(name), has_locks);
        EXPECT_NE(message.find("process " + std::to_string(getpid()) + " on host"), std::string::npos)
            << message;
      }
      EXPECT_EQ(lock_refusal(scratch.file("other.h5"), has_locks), "locked");
    }
    EXPECT_EQ(lock_refusal(scratch.file("link.h5"), has_locks), "locked");
    EXPECT_EQ(scratch.num_files(), 1u) << "the link alone";
  }
}

TEST(OutputLock, is_freed_by_death_and_cleans_up_after_the_dead) {
  for (const bool has_locks : {true, false}) {
    const Scratch scratch;
    const pid_t child = fork();
    if (child == 0) {
      const OutputLock lock(scratch.file("run.h5"), has_locks);
      std::ofstream(lock.temporary_path()) << "half";
      raise(SIGKILL);
    }
    int status = 0;
    waitpid(child, &status, 0);
    ASSERT_TRUE(WIFSIGNALED(status));
    EXPECT_EQ(scratch.num_files(), 2u) << "lock and half a file";
    EXPECT_EQ(lock_refusal(scratch.file("run.h5"), has_locks), "locked");
    EXPECT_EQ(scratch.num_files(), 0u);
  }
}

TEST(OutputLock, removes_what_dead_processes_left_though_no_lock_names_it) {
  const Scratch scratch;
  const pid_t child = fork();
  if (child == 0) _exit(0);
  std::string mine;
  { mine = OutputLock(scratch.file("run.h5")).temporary_path(); }
  const auto name_of = [&](pid_t process) {
    const std::string own = std::to_string(getpid()) + ".part";
    return mine.substr(0, mine.size() - own.size()) + std::to_string(process) + ".part";
  };
  int status = 0;
  waitpid(child, &status, 0);
  const std::string of_init = name_of(1), of_other_host = scratch.file("run.h5.elsewhere-1.part");
  for (const std::string& name : {name_of(child), of_init, of_other_host}) std::ofstream(name) << "half";
  EXPECT_EQ(lock_refusal(scratch.file("run.h5"), true), "locked");
  EXPECT_FALSE(std::filesystem::exists(name_of(child)));
  EXPECT_TRUE(std::filesystem::exists(of_init)) << "that process lives";
  EXPECT_TRUE(std::filesystem::exists(of_other_host));
}

TEST(OutputLock, refuses_a_lock_file_that_is_not_a_regular_file) {
  for (const bool has_locks : {true, false}) {
    const Scratch scratch;
    ASSERT_EQ(mkfifo(scratch.file(".run.h5.lock").c_str(), 0600), 0);
    EXPECT_NE(lock_refusal(scratch.file("run.h5"), has_locks).find("not a regular file"), std::string::npos);
  }
}

TEST(OutputLock, has_names_that_fit_for_the_longest_file_name) {
  const Scratch scratch;
  const OutputLock lock(scratch.file(std::string(252, 'x') + ".h5"));
  std::ofstream(lock.temporary_path()) << "content";
  EXPECT_EQ(scratch.num_files(), 2u);
  std::filesystem::remove(lock.temporary_path());
}

TEST(OutputTarget, asks_the_disk_for_no_room_that_will_hardly_be_needed) {
  const Scratch scratch;
  constexpr std::int64_t more_than_a_disk = std::int64_t{1} << 43;
  OutputTarget target(scratch.file("run.h5"), 1);
  std::filesystem::resize_file(target.temporary_path(), more_than_a_disk);
  EXPECT_THROW(target.publish(), core::InputError);
  target.publish(more_than_a_disk);
  EXPECT_TRUE(std::filesystem::exists(scratch.file("run.h5")));
}

TEST(OutputTarget, refuses_more_than_the_disk_holds_and_leaves_nothing_behind) {
  const Scratch scratch;
  // 4 EiB, more than any file system here; some report "too large" before they check the free space.
  const std::string message = refusal(scratch.file("run.h5"), std::int64_t{1} << 62);
  EXPECT_NE(message.find("do not fit"), std::string::npos) << message;
  EXPECT_EQ(scratch.num_files(), 0u);
}

}  // namespace
}  // namespace pbmpi::io::test
