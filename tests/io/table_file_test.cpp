#include "io/table/table_file.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <limits>

#include "core/error.h"
#include "io/file/write_file.h"
#include "scratch.h"

namespace pbmpi::io::test {
namespace {

TableFile sample() {
  TableFile file;
  file.attributes = {{"study", "accuracy"}};
  file.parameters = {Parameter::of("seed", std::int64_t{7}), Parameter::of("factor", 1.5)};
  const double inf = std::numeric_limits<double>::infinity();
  file.tables["cases"] = {{"scene", "", std::vector<std::string>{"a", "", "longer"}},
                          {"error", "m", std::vector<double>{1.25, inf, -3}},
                          {"bands", "", std::vector<std::int64_t>{1, 2, 3, 4, 5, 6}, 2}};
  return file;
}

std::string refusal(const std::string& path, const std::string& type) {
  try {
    read_table_file(path, type);
  } catch (const core::InputError& error) {
    return error.what();
  }
  return "";
}

TEST(TableFile, reads_back_what_was_written) {
  const Scratch scratch;
  const std::string path = scratch.file("study.h5");
  TableWriter(path).write("pbmpi-test", sample());
  const TableFile found = read_table_file(path, "pbmpi-test");
  EXPECT_EQ(found.attributes.at("study"), "accuracy");
  EXPECT_EQ(found.column<std::string>("cases", "scene"), (std::vector<std::string>{"a", "", "longer"}));
  EXPECT_EQ(found.column<double>("cases", "error"),
            (std::vector<double>{1.25, std::numeric_limits<double>::infinity(), -3}));
  EXPECT_EQ(found.column<std::int64_t>("cases", "bands"), (std::vector<std::int64_t>{1, 2, 3, 4, 5, 6}));
  ASSERT_EQ(found.parameters.size(), 2u);
  EXPECT_EQ(found.parameters[0].text, "1.5");
  EXPECT_EQ(found.parameters[1].text, "7");
  EXPECT_EQ(filetype_of(path), "pbmpi-test");
}

TEST(TableFile, a_missing_column_or_another_type_is_named) {
  const TableFile file = sample();
  EXPECT_THROW(file.column<double>("cases", "absent"), core::InputError);
  EXPECT_THROW(file.column<double>("cases", "scene"), core::InputError);
}

TEST(TableFile, other_files_are_refused) {
  const Scratch scratch;
  const std::string path = scratch.file("study.h5");
  TableWriter(path).write("pbmpi-test", sample());
  EXPECT_NE(refusal(path, "pbmpi-study").find("not a pbmpi-study"), std::string::npos);
  EXPECT_NE(refusal(scratch.file("absent.h5"), "pbmpi-study").find("no such file"), std::string::npos);
  std::ofstream(scratch.file("text.h5")) << "text";
  EXPECT_NE(refusal(scratch.file("text.h5"), "pbmpi-study").find("HDF5"), std::string::npos);
  EXPECT_EQ(filetype_of(scratch.file("text.h5")), "");
  EXPECT_EQ(filetype_of(scratch.file("absent.h5")), "");
}

std::string refusal_to_replace(const std::string& path, const std::string& filetype) {
  try {
    output_target(path, filetype, 1000);
    return "";
  } catch (const core::InputError& error) {
    return error.what();
  }
}

TEST(TableFile, replaces_only_a_file_of_its_own_type) {
  const Scratch scratch;
  const std::string path = scratch.file("a.h5");
  const auto put = [&](const std::string& filetype, std::int64_t minor) {
    replace_file(OutputLock(path), table_image(filetype, {1, minor}, sample()));
  };
  EXPECT_EQ(refusal_to_replace(path, "pbmpi-test"), "");
  put("pbmpi-test", 6);
  EXPECT_EQ(refusal_to_replace(path, "pbmpi-test"), "");
  EXPECT_NE(refusal_to_replace(path, "pbmpi-run").find("pbmpi-test"), std::string::npos);
  put("", 0);
  EXPECT_NE(refusal_to_replace(path, "pbmpi-run").find("no readable attribute filetype"), std::string::npos);
  EXPECT_NE(refusal_to_replace(path, "").find("no readable"), std::string::npos) << "an empty type is none";
  EXPECT_EQ(scratch.num_files(), 1u);
}

/// Behind a block of the user's own HDF5 begins at byte 512 or a power of two above it.
TEST(TableFile, sees_hdf5_behind_a_users_block) {
  const Scratch scratch;
  const std::vector<std::byte> image = table_image("pbmpi-test", {1, 0}, sample());
  for (const std::size_t block : {512u, 1024u, 4096u}) {
    const std::string path = scratch.file("block" + std::to_string(block));
    std::ofstream file(path, std::ios::binary);
    file << std::string(block, ' ');
    file.write(reinterpret_cast<const char*>(image.data()), std::ssize(image));
    file.close();
    EXPECT_EQ(content_of(path), Content::hdf5) << block;
    EXPECT_THROW(write_file(path, "text"), core::InputError) << block;
  }
  std::ofstream(scratch.file("text")) << std::string(600, ' ') << "\x89HDF\r\n\x1a\n";
  EXPECT_EQ(content_of(scratch.file("text")), Content::other);
}

TEST(TableFile, any_bit_that_changed_is_noticed) {
  const Scratch scratch;
  const std::string path = scratch.file("study.h5");
  TableWriter(path).write("pbmpi-test", sample());
  const auto size = static_cast<std::size_t>(std::filesystem::file_size(path));
  ASSERT_GT(size, 2000u);
  for (std::size_t at = 0; at < size; at += 97) {
    const auto flip = [&] {
      std::fstream file(path, std::ios::binary | std::ios::in | std::ios::out);
      file.seekg(static_cast<std::streamoff>(at));
      const char flipped = static_cast<char>(file.get() ^ (1 << (at % 8)));
      file.seekp(static_cast<std::streamoff>(at));
      file.put(flipped);
    };
    flip();
    EXPECT_NE(refusal(path, "pbmpi-test").find("damaged"), std::string::npos) << "byte " << at;
    flip();
  }
  EXPECT_EQ(refusal(path, "pbmpi-test"), "");
  std::filesystem::resize_file(path, size - 24);  // the seal
  EXPECT_NE(refusal(path, "pbmpi-test").find("checksum is missing"), std::string::npos);
}

TEST(TableFile, of_layout_1_2_is_read_without_a_checksum) {
  const Scratch scratch;
  const std::string path = scratch.file("study.h5");
  const std::vector<std::byte> image = table_image("pbmpi-test", {1, 2}, sample());
  std::ofstream(path, std::ios::binary).write(reinterpret_cast<const char*>(image.data()), std::ssize(image));
  EXPECT_EQ(read_table_file(path, "pbmpi-test").parameters.size(), 2u);
}

TEST(TableFile, nothing_appears_before_it_is_written_and_bad_places_are_refused_at_once) {
  const Scratch scratch;
  const std::string path = scratch.file("study.h5");
  { const TableWriter writer(path); }
  EXPECT_EQ(scratch.num_files(), 0u);
  EXPECT_THROW(TableWriter(scratch.file("no/folder/study.h5")), core::InputError);
}

}  // namespace
}  // namespace pbmpi::io::test
