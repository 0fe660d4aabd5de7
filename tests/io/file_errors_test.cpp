#include <gtest/gtest.h>

#include <fstream>

#include "core/error.h"
#include "io/hdf5/hdf5_handle.h"
#include "io/run/run_data.h"
#include "io/run/xdmf.h"
#include "shared_folder.h"

namespace pbmpi::io::test {
namespace {

const mpi::Communicator& world() {
  static const mpi::Communicator communicator = mpi::Communicator::world();
  return communicator;
}

/// The message with which read_run refuses a file.
std::string refusal(const std::string& path) {
  try {
    read_run(path);
  } catch (const core::InputError& error) {
    return error.what();
  }
  return "read " + path;
}

void expect_refusal(const std::string& path, const std::string& reason) {
  const std::string message = refusal(path);
  EXPECT_EQ(message.rfind(path, 0), 0u) << message;
  EXPECT_NE(message.find(reason), std::string::npos) << message;
}

/// Overwrites the first value of an attribute of the root.
void set_attribute(const std::string& path, const char* name, hid_t type, const void* value) {
  const File file(H5Fopen(path.c_str(), H5F_ACC_RDWR, H5P_DEFAULT));
  const Group root(H5Gopen2(file.id(), "/", H5P_DEFAULT));
  const Attribute attribute(H5Aopen(root.id(), name, H5P_DEFAULT));
  ASSERT_GE(H5Awrite(attribute.id(), type, value), 0);
}

TEST(RunFile, refuses_an_impossible_path_on_every_rank_alike) {
  const SharedFolder folder(world());
  const Sample sample = sample_on(world());
  for (const std::string& path :
       {folder.file("missing/run.h5"), folder.file("."), std::string("/dev/null")}) {
    try {
      begin_run(world(), sample, path, 0);
      ADD_FAILURE() << "created " << path;
    } catch (const core::InputError& error) {
      EXPECT_NE(std::string(error.what()).find("cannot create"), std::string::npos) << error.what();
    }
  }
  world().barrier();
  if (world().is_root()) {
    EXPECT_EQ(folder.num_files(), 0u);
  }
}

TEST(ReadRun, refuses_what_is_not_there_or_not_hdf5) {
  if (!world().is_root()) return;
  const Scratch scratch;
  expect_refusal(scratch.file("none.h5"), "no such file");
  expect_refusal(scratch.folder().string(), "directory");
  std::ofstream(scratch.file("text.h5")) << "these are not the bytes of HDF5";
  expect_refusal(scratch.file("text.h5"), "HDF5");
  { const std::ofstream empty(scratch.file("empty.h5")); }
  expect_refusal(scratch.file("empty.h5"), "HDF5");
}

TEST(ReadRun, refuses_another_file_type_and_a_newer_layout) {
  const SharedFolder folder(world());
  const std::string path = folder.file("run.h5");
  begin_run(world(), sample_on(world()), path, 2)->close(false, "");
  if (!world().is_root()) return;
  const std::int64_t newer[2] = {2, 0};
  set_attribute(path, "version", H5T_NATIVE_INT64, newer);
  expect_refusal(path, "version 2.0");
  const Datatype type(H5Tcopy(H5T_C_S1));
  ASSERT_GE(H5Tset_size(type.id(), 9), 0);
  ASSERT_GE(H5Tset_strpad(type.id(), H5T_STR_NULLPAD), 0);
  ASSERT_GE(H5Tset_cset(type.id(), H5T_CSET_UTF8), 0);
  set_attribute(path, "filetype", type.id(), "other-run");
  expect_refusal(path, "\"other-run\"");
  { const File bare(H5Fcreate(folder.file("bare.h5").c_str(), H5F_ACC_TRUNC, H5P_DEFAULT, H5P_DEFAULT)); }
  expect_refusal(folder.file("bare.h5"), "filetype is missing");
}

TEST(ReadRun, refuses_a_file_that_promises_more_frames_than_it_has) {
  const SharedFolder folder(world());
  const std::string path = folder.file("run.h5");
  begin_run(world(), sample_on(world()), path, 2)->close(false, "");
  if (!world().is_root()) return;
  const std::int64_t frames = 5;
  set_attribute(path, "frames_committed", H5T_NATIVE_INT64, &frames);
  expect_refusal(path, "damaged");
}

TEST(ReadRun, refuses_a_file_that_was_cut_short) {
  const SharedFolder folder(world());
  const std::string path = folder.file("run.h5");
  begin_run(world(), sample_on(world()), path, 2)->close(false, "");
  if (!world().is_root()) return;
  std::filesystem::resize_file(path, std::filesystem::file_size(path) / 2);
  expect_refusal(path, "cannot be opened");
}

TEST(Xdmf, refuses_a_run_that_is_not_there_and_a_folder_that_is_not_there) {
  const SharedFolder folder(world());
  const std::string path = folder.file("run.h5");
  begin_run(world(), sample_on(world()), path, 2)->close(false, "");
  if (!world().is_root()) return;
  EXPECT_THROW(write_xdmf(folder.file("none.h5"), folder.file("run.xdmf")), core::InputError);
  EXPECT_THROW(write_xdmf(path, folder.file("missing/run.xdmf")), core::InputError);
  EXPECT_EQ(folder.num_files(), 1u);
}

}  // namespace
}  // namespace pbmpi::io::test
