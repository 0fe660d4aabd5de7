#include "io/run/checkpoint_file.h"

#include <gtest/gtest.h>
#include <sys/resource.h>

#include <filesystem>
#include <fstream>
#include <limits>

#include "core/error.h"
#include "io/file/write_file.h"
#include "io/table/table_file.h"
#include "model/state_parts.h"
#include "scratch.h"

namespace pbmpi::io::test {
namespace {

/// Worlds of different sizes: with rest, with joints and forces, with contact forces only.
Checkpoint sample() {
  Checkpoint checkpoint;
  checkpoint.pbmpi_version = "0.1.0";
  checkpoint.git_revision = "abc";
  checkpoint.build = "GNU 12";
  checkpoint.created = "2026-01-02T03:04:05Z";
  checkpoint.scene = "crates";
  checkpoint.scene_text = "title = \"Krümel\"\n\n[run]\n";
  checkpoint.options = "dt = 0.01\neffects = +friction\n";
  checkpoint.frames = 12;
  checkpoint.steps = 36;
  checkpoint.state_hash = "0123456789abcdef";
  for (int world = 0; world < 3; ++world) {
    model::State& state = checkpoint.worlds.emplace_back();
    state.resize(world + 1);
    for (int body = 0; body <= world; ++body) {
      state.position[body] = {0.1 * world, 1.0 / 3 * body, std::numeric_limits<double>::denorm_min()};
      state.orientation[body] = {0.9, 0.1 * body, -0.0, 1e-300};
      state.velocity[body] = {-1.0 * world, 1e300, 2};
      state.angular_velocity[body] = {0.7, -0.1 * body, std::numeric_limits<double>::infinity()};
    }
    if (world == 1) {
      state.rest = {{{1, 2, 3}, {0.5, 0.5, 0.5, 0.5}, -1}, {{4, 5, 6}, {}, 17}};
      state.rest[1].velocity = {7, 8, -0.0};
      state.rest[1].watches = {{{17, {}, 0.1, 0.2}, {3, {{{{9, 10, 11}, {12, 13, 14, 15}}, {}}}, 0.3, 0.4}}};
    }
    if (world == 2) state.broken_in = {-1, 31, -1, 7};
    for (int point = 0; world != 1 && point <= world; ++point) {
      state.memory.contacts.push_back(
          {{0, 7 + point}, world, point - 1, {0.1 * point, -0.0, 1e-300}, 1.0 / 3, {1, 2, 1e300}});
    }
    if (world == 2)
      state.memory.joints = {{{1, -0.0, 3}, {4, 5, 1.0 / 7}, {6, 7}}, {}, {}, {{}, {}, {0, -9}}};
    state.guard = {1.0 / 3, 1e300 * world, world == 0 ? 17 : -1};
  }
  return checkpoint;
}

std::vector<double> rest_rows(const model::State& state) {
  std::vector<double> rows;
  model::append_rows(state.rest, rows);
  return rows;
}

TEST(CheckpointFile, comes_back_as_it_was_written) {
  const Scratch scratch;
  const std::string path = scratch.file("run.ck.h5");
  const Checkpoint written = sample();
  const std::int64_t bytes = write_checkpoint(OutputLock(path), written);
  EXPECT_EQ(static_cast<std::int64_t>(std::filesystem::file_size(path)), bytes);
  const Checkpoint found = read_checkpoint(path);
  EXPECT_EQ(found.scene_text, written.scene_text);
  EXPECT_EQ(found.scene_file, "");
  EXPECT_EQ(found.options, written.options);
  EXPECT_EQ(found.output, "");
  EXPECT_EQ(found.build, written.build);
  EXPECT_EQ(found.state_hash, written.state_hash);
  EXPECT_EQ(found.frames, 12);
  EXPECT_EQ(found.steps, 36);
  ASSERT_EQ(found.worlds.size(), 3u);
  for (std::size_t world = 0; world < 3; ++world) {
    const model::State &a = found.worlds[world], &b = written.worlds[world];
    EXPECT_EQ(model::hash(a), model::hash(b))
        << "all bits of poses, velocities and forces, and what is broken";
    EXPECT_EQ(a.memory.contacts.size(), b.memory.contacts.size());
    EXPECT_EQ(a.memory.joints.size(), b.memory.joints.size());
    EXPECT_EQ(a.broken_in, b.broken_in);
    EXPECT_EQ(a.guard.energy_gain_j, b.guard.energy_gain_j);
    EXPECT_EQ(a.guard.largest_kinetic_j, b.guard.largest_kinetic_j);
    EXPECT_EQ(a.guard.frozen_in, b.guard.frozen_in);
    EXPECT_EQ(rest_rows(a), rest_rows(b));
  }
  EXPECT_EQ(scratch.num_files(), 1u) << "nothing else is left";
}

/// The sample's tables as input of table_image(): without the attributes that it adds.
TableFile tables_of_sample(const std::string& path) {
  write_checkpoint(OutputLock(path), sample());
  TableFile file = read_table_file(path, "pbmpi-checkpoint", 1);
  file.attributes.erase("filetype");
  file.attributes.erase("version");
  return file;
}

TEST(CheckpointFile, of_layout_1_1_is_read_without_forces) {
  const Scratch scratch;
  const std::string path = scratch.file("run.ck.h5");
  TableFile file = tables_of_sample(path);
  file.tables.erase("contact_forces");
  file.tables.erase("joint_forces");
  std::erase_if(file.tables["worlds"],
                [](const TableColumn& column) { return column.name.ends_with("_forces"); });
  replace_file(OutputLock(path), table_image("pbmpi-checkpoint", {1, 1}, file));
  const Checkpoint found = read_checkpoint(path);
  ASSERT_EQ(found.worlds.size(), 3u);
  for (std::size_t world = 0; world < 3; ++world) {
    model::State expected = sample().worlds[world];
    expected.memory.clear();
    EXPECT_TRUE(found.worlds[world].memory.empty());
    EXPECT_EQ(model::hash(found.worlds[world]), model::hash(expected));
  }
}

TEST(CheckpointFile, of_layout_1_4_has_awake_bodies_begin_to_rest_anew) {
  const Scratch scratch;
  const std::string path = scratch.file("run.ck.h5");
  TableFile file = tables_of_sample(path);
  std::erase_if(file.tables["rest"], [](const TableColumn& column) {
    return column.name.find("velocity") != std::string::npos || column.name.starts_with("short_") ||
           column.name.starts_with("long_");
  });
  replace_file(OutputLock(path), table_image("pbmpi-checkpoint", {1, 4}, file));
  const model::State found = read_checkpoint(path).worlds[1];
  EXPECT_EQ(found.rest[0].island(), 0);
  EXPECT_EQ(found.rest[0].position, sample().worlds[1].rest[0].position);
  std::array<double, model::row_width<model::Rest>> row, expected;
  model::put_row(found.rest[1], row.data());
  model::put_row(model::begin_rest(sample().worlds[1], 1), expected.data());
  EXPECT_EQ(row, expected);
}

/// Writes a sample whose integer column /TABLE/NAME was changed.
template <class Change>
void write_damaged(const std::string& path, const std::string& table, const std::string& name,
                   const Change& change) {
  TableFile file = tables_of_sample(path);
  for (TableColumn& column : file.tables.at(table)) {
    if (column.name == name) change(std::get<std::vector<std::int64_t>>(column.values));
  }
  replace_file(OutputLock(path), table_image("pbmpi-checkpoint", {1, 3}, file));
}

TEST(CheckpointFile, whose_forces_do_not_fit_is_refused) {
  using Integers = std::vector<std::int64_t>;
  const Scratch scratch;
  const std::string path = scratch.file("run.ck.h5");
  const auto expect_refused = [&](const std::string& table, const std::string& name, const auto& change) {
    write_damaged(path, table, name, change);
    EXPECT_THROW(read_checkpoint(path), core::InputError) << table << " " << name;
  };
  expect_refused("worlds", "contact_forces", [](Integers& counts) { ++counts[1]; });
  expect_refused("worlds", "contact_forces", [](Integers& counts) { --counts[2]; });
  expect_refused("worlds", "joint_forces", [](Integers& counts) { counts[2] = 1'000'000'000'000; });
  expect_refused("contact_forces", "geoms", [](Integers& geoms) { geoms[3] = std::int64_t{1} << 40; });
}

TEST(CheckpointFile, replaces_the_one_before_also_behind_a_link) {
  const Scratch scratch;
  const std::string path = scratch.file("run.ck.h5"), link = scratch.file("link.h5");
  Checkpoint checkpoint = sample();
  write_checkpoint(OutputLock(path), checkpoint);
  std::filesystem::create_symlink(path, link);
  checkpoint.frames = 13;
  write_checkpoint(OutputLock(link), checkpoint);
  EXPECT_TRUE(std::filesystem::is_symlink(link));
  EXPECT_EQ(read_checkpoint(path).frames, 13);
}

TEST(CheckpointFile, any_bit_that_changed_is_noticed) {
  const Scratch scratch;
  const std::string path = scratch.file("run.ck.h5");
  const auto size = static_cast<std::size_t>(write_checkpoint(OutputLock(path), sample()));
  for (std::size_t at = 0; at < size; at += 131) {
    std::fstream file(path, std::ios::binary | std::ios::in | std::ios::out);
    file.seekg(static_cast<std::streamoff>(at));
    const char was = static_cast<char>(file.get());
    file.seekp(static_cast<std::streamoff>(at));
    file.put(static_cast<char>(was ^ (1 << (at % 8)))).flush();
    EXPECT_THROW(read_checkpoint(path), core::InputError) << "byte " << at;
    file.seekp(static_cast<std::streamoff>(at));
    file.put(was);
  }
  EXPECT_EQ(read_checkpoint(path).frames, sample().frames);
}

TEST(CheckpointFile, that_is_cut_off_anywhere_is_refused) {
  const Scratch scratch;
  const std::string path = scratch.file("run.ck.h5");
  const auto bytes = static_cast<std::uintmax_t>(write_checkpoint(OutputLock(path), sample()));
  for (int tenth = 0; tenth < 10; ++tenth) {
    write_checkpoint(OutputLock(path), sample());
    std::filesystem::resize_file(path, bytes * static_cast<std::uintmax_t>(tenth) / 10);
    EXPECT_THROW(read_checkpoint(path), core::InputError) << tenth;
  }
}

TEST(CheckpointFile, places_that_cannot_be_written_are_found_out_without_leaving_a_file) {
  const Scratch scratch;
  EXPECT_NO_THROW(lock_checkpoint(scratch.file("run.ck.h5"), 1000));
  EXPECT_EQ(scratch.num_files(), 0u);
  EXPECT_THROW(lock_checkpoint(scratch.file("no/run.ck.h5"), 1000), core::InputError);
  EXPECT_THROW(lock_checkpoint(scratch.folder().string(), 1000), core::InputError);
}

std::string text_of(const std::string& path) {
  std::ifstream file(path);
  return {std::istreambuf_iterator<char>(file), {}};
}

std::span<const std::byte> bytes_of(const std::string& text) {
  return std::as_bytes(std::span(text.data(), text.size()));
}

TEST(ReplaceFile, that_cannot_be_written_leaves_the_old_one_and_says_why) {
  const Scratch scratch;
  const std::string path = scratch.file("file");
  replace_file(OutputLock(path), bytes_of("old"));
  rlimit limit{};
  ASSERT_EQ(getrlimit(RLIMIT_FSIZE, &limit), 0);
  const rlimit small{100, limit.rlim_max};
  ASSERT_EQ(setrlimit(RLIMIT_FSIZE, &small), 0);
  std::string message;
  try {
    replace_file(OutputLock(path), bytes_of(std::string(101, 'x')));
  } catch (const core::RunError& error) {
    message = error.what();
  }
  ASSERT_EQ(setrlimit(RLIMIT_FSIZE, &limit), 0);
  EXPECT_EQ(message, "cannot write " + path + ": File too large");
  EXPECT_EQ(text_of(path), "old");
  EXPECT_EQ(scratch.num_files(), 1u);
  EXPECT_THROW(OutputLock(scratch.file("no/file")), core::InputError);
}

}  // namespace
}  // namespace pbmpi::io::test
