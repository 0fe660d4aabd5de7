#include "io/hdf5/hdf5_handle.h"

#include <gtest/gtest.h>

#include "core/error.h"
#include "io/hdf5/columns.h"

namespace pbmpi::io::test {
namespace {

bool is_open(hid_t id) { return H5Iis_valid(id) > 0; }

TEST(Hdf5Handle, closes_its_id_once_and_moves_it) {
  hid_t id = -1;
  {
    Dataspace first(H5Screate(H5S_SCALAR));
    id = first.id();
    Dataspace second = std::move(first);
    EXPECT_EQ(second.id(), id);
    EXPECT_TRUE(is_open(id));
  }
  EXPECT_FALSE(is_open(id));
}

TEST(Hdf5Handle, closes_the_old_id_when_it_takes_a_new_one) {
  Dataspace space(H5Screate(H5S_SCALAR));
  const hid_t old = space.id();
  space = Dataspace(H5Screate(H5S_SCALAR));
  EXPECT_FALSE(is_open(old));
  EXPECT_TRUE(is_open(space.id()));
  const hid_t released = space.release();
  space.close();
  EXPECT_TRUE(is_open(released));
  EXPECT_GE(H5Sclose(released), 0);
}

TEST(Hdf5Handle, puts_the_call_and_the_reason_into_the_error) {
  prepare_hdf5();
  try {
    owned<File>(H5Fopen("/nowhere/at.all", H5F_ACC_RDONLY, H5P_DEFAULT), "H5Fopen");
    FAIL() << "no error";
  } catch (const core::RunError& error) {
    const std::string message = error.what();
    EXPECT_EQ(message.rfind("H5Fopen: ", 0), 0u) << message;
    EXPECT_NE(message.find("No such file or directory"), std::string::npos) << message;
  }
}

TEST(CutText, ends_between_two_characters) {
  EXPECT_EQ(cut_text("abc", 3), "abc");
  EXPECT_EQ(cut_text("abc", 2), "ab");
  EXPECT_EQ(cut_text("aé", 2), "a");  // é has two bytes
  EXPECT_EQ(cut_text("aé", 3), "aé");
  EXPECT_EQ(cut_text("é", 1), "");
}

}  // namespace
}  // namespace pbmpi::io::test
