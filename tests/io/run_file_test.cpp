// This file is long because each case writes and reads a file, and checks another part of it.
#include "io/run/run_file.h"

#include <gtest/gtest.h>

#include <filesystem>

#include "core/error.h"
#include "shared_folder.h"
#include "whole_run.h"

namespace pbmpi::io::test {
namespace {

const mpi::Communicator& world() {
  static const mpi::Communicator communicator = mpi::Communicator::world();
  return communicator;
}

void expect_profiles(const WholeRun& run, const Sample& sample, std::int64_t num_frames) {
  ASSERT_EQ(run.islands.size(), static_cast<std::size_t>(sample.profile ? num_frames : 0));
  for (std::size_t k = 0; k < run.islands.size(); ++k) {
    std::size_t row = 0;
    std::int64_t first_of_world = 0;
    for (int w = 0; w < sample.num_worlds; ++w) {
      const stepping::StepProfile profile = sample_profile(sample, w, static_cast<std::int64_t>(k));
      for (const stepping::IslandCost& island : profile.islands) {
        ASSERT_LT(row, run.islands[k].size());
        const IslandRow& found = run.islands[k][row++];
        EXPECT_EQ(found.first_body, first_of_world + island.first_body);
        EXPECT_EQ(found.bodies, island.bodies);
        EXPECT_EQ(found.contacts, island.contacts);
        EXPECT_EQ(found.rows, island.rows);
        EXPECT_EQ(found.solve_s, island.solve_s);
      }
      first_of_world += sample.bodies_per_world + w % 2;
      EXPECT_EQ(run.space_times.at("cross_contacts")[k][w], profile.cross_contacts);
      EXPECT_EQ(run.space_times.at("collide_spaces")[k][w], profile.collide_spaces_s);
    }
    EXPECT_EQ(row, run.islands[k].size());
  }
}

/// Expects every number of the sample's first `num_frames` frames, bit for bit: nothing in between computes.
void expect_sample(const WholeRun& run, const Sample& sample, std::int64_t num_frames) {
  ASSERT_EQ(run.frames_committed, num_frames);
  ASSERT_EQ(run.num_worlds, sample.num_worlds);
  ASSERT_EQ(run.num_ranks, sample.num_ranks);
  ASSERT_EQ(run.position.size(), static_cast<std::size_t>(num_frames / sample.record_every));
  for (std::size_t row = 0; row < run.position.size(); ++row) {
    const std::int64_t frame = (static_cast<std::int64_t>(row) + 1) * sample.record_every - 1;
    EXPECT_EQ(run.recorded_step[row], 3 * (frame + 1));
    ASSERT_EQ(run.position[row].size(), run.bodies.id.size());
    for (std::size_t i = 0; i < run.bodies.id.size(); ++i) {
      const model::State state = sample_state(sample, run.bodies.world[i], frame);
      EXPECT_EQ(run.position[row][i], state.position[run.bodies.local_body[i]])
          << "frame " << frame << " body " << i;
      EXPECT_EQ(run.orientation[row][i], state.orientation[run.bodies.local_body[i]]);
    }
  }
  expect_profiles(run, sample, num_frames);
  for (std::int64_t k = 0; k < num_frames; ++k) {
    EXPECT_EQ(run.frame_wall_s[k], sample_wall_s(k));
    EXPECT_EQ(run.frame_measured[k], k >= 2);
    EXPECT_EQ(run.deadline_met[k], k % 2 == 0);
    for (int w = 0; w < sample.num_worlds; ++w) {
      const stepping::Observables seen = sample_observables(w, k);
      EXPECT_EQ(run.observables.at("contacts")[k][w], seen.contacts);
      EXPECT_EQ(run.observables.at("energy")[k][w], seen.energy_j);
      EXPECT_EQ(run.observables.at("joint_gap")[k][w], seen.joint_gap_m);
      for (int axis = 0; axis < 3; ++axis) {
        EXPECT_EQ(run.vector_observables.at("linear_momentum")[k][w][axis], seen.linear_momentum[axis]);
        EXPECT_EQ(run.vector_observables.at("angular_momentum")[k][w][axis], seen.angular_momentum[axis]);
      }
    }
    for (int r = 0; r < sample.num_ranks; ++r) {
      EXPECT_EQ(run.rank_times.at("collide")[k][r], sample_phase_s(r, 0, k));
      EXPECT_EQ(run.rank_times.at("output")[k][r], sample_phase_s(r, core::num_phases - 1, k));
      EXPECT_EQ(run.rank_times.at("processor")[k][r], 1e-3 * static_cast<double>(k + 100 * r));
      EXPECT_EQ(run.rank_times.at("messages")[k][r], k + 10 * r);
      EXPECT_EQ(run.rank_times.at("bytes")[k][r], 8 * k + 1000 * r);
    }
  }
}

TEST(RunFile, reads_back_every_number_of_a_complete_run) {
  const SharedFolder folder(world());
  const Sample sample = sample_on(world());
  const std::string path = folder.file("run.h5");
  auto file = begin_run(world(), sample, path, sample.num_frames);
  file->event({.frame = 4, .kind = "rebalance", .detail = "moved 2 worlds", .value = 2});
  file->event({5, "joint_broken", "a hinge", 17, 1, 3, "door.hinge"});
  file->close(true, "0123456789abcdef");
  file.reset();  // releases the lock
  if (!world().is_root()) return;

  const WholeRun run = read_whole_run(path);
  expect_sample(run, sample, sample.num_frames);
  EXPECT_TRUE(run.complete);
  EXPECT_EQ(run.attributes.at("state_hash"), "0123456789abcdef");
  EXPECT_EQ(run.attributes.at("scene"), "Sample");
  EXPECT_EQ(run.attributes.at("seed"), "7");
  EXPECT_EQ(run.attributes.at("version"), "1.8");
  EXPECT_EQ(run.parameters.at("dt_s"), "0.01");
  EXPECT_EQ(run.parameters.at("scene_text"), "[[actor]]\nkind = \"human\"\n");
  EXPECT_EQ(run.parameters.at("empty"), "");
  ASSERT_EQ(run.events.size(), 2u);
  EXPECT_EQ(run.events[0].frame, 4);
  EXPECT_EQ(run.events[0].kind, "rebalance");
  EXPECT_EQ(run.events[0].detail, "moved 2 worlds");
  EXPECT_EQ(run.events[0].value, 2);
  EXPECT_EQ(run.events[0].world, -1);
  EXPECT_EQ(run.events[1].step, 17);
  EXPECT_EQ(run.events[1].world, 1);
  EXPECT_EQ(run.events[1].joint, 3);
  EXPECT_EQ(run.events[1].name, "door.hinge");
  EXPECT_EQ(folder.num_files(), 1u) << "only the file itself is left in the folder";
}

TEST(RunFile, describes_bodies_and_geoms_in_world_order) {
  const SharedFolder folder(world());
  const Sample sample = sample_on(world());
  const std::string path = folder.file("run.h5");
  begin_run(world(), sample, path, 1)->close(false, "");
  if (!world().is_root()) return;

  const WholeRun run = read_whole_run(path);
  std::size_t body = 0, geom = 0;
  for (int w = 0; w < sample.num_worlds; ++w) {
    const auto model = sample_model(sample, w);
    const auto offset = static_cast<std::int64_t>(body);
    for (int b = 0; b < model->num_bodies(); ++b, ++body) {
      ASSERT_LT(body, run.bodies.id.size());
      EXPECT_EQ(run.bodies.id[body], static_cast<std::int64_t>(body));
      EXPECT_EQ(run.bodies.world[body], w);
      EXPECT_EQ(run.bodies.local_body[body], b);
      EXPECT_EQ(run.bodies.name[body], model->bodies[b].name);
      EXPECT_EQ(run.bodies.actor[body], "human1");
      EXPECT_EQ(run.bodies.kind[body], "human");
      EXPECT_EQ(run.bodies.mass_kg[body], model->bodies[b].mass_kg);
      EXPECT_EQ(run.bodies.initial[body].position, model->bodies[b].pose.position);
    }
    for (const model::Geom& expected : model->geoms) {
      ASSERT_LT(geom, run.geoms.size());
      const GeomRow& row = run.geoms[geom++];
      EXPECT_EQ(row.world, w);
      EXPECT_EQ(row.body, expected.body == model::no_body ? -1 : offset + expected.body);
      EXPECT_EQ(row.kind, expected.body == model::no_body ? "ground" : "human");
      EXPECT_EQ(row.size, expected.size);
      EXPECT_EQ(row.local.position, expected.local.position);
    }
  }
  EXPECT_EQ(run.bodies.id.size(), body);
  EXPECT_EQ(run.geoms.size(), geom);
}

// A search of all geoms for each body would not end.
TEST(RunFile, describes_the_bodies_of_a_large_world) {
  if (world().size() > 1) GTEST_SKIP() << "one rank has the world";
  const SharedFolder folder(world());
  Sample sample = sample_on(world());
  sample.num_worlds = 1;
  sample.bodies_per_world = 400'000;
  const std::string path = folder.file("run.h5");
  begin_run(world(), sample, path, 0)->close(false, "");
  if (!world().is_root()) return;
  const WholeRun run = read_whole_run(path);
  ASSERT_EQ(run.bodies.name.size(), 400'000u);
  EXPECT_EQ(run.bodies.name.back(), sample_model(sample, 0)->bodies.back().name);
}

TEST(RunFile, keeps_the_rows_of_worlds_that_migrate_between_frames) {
  const SharedFolder folder(world());
  Sample sample = sample_on(world());
  sample.num_worlds = 9;
  sample.num_frames = 12;
  const int ranks = sample.num_ranks;
  sample.owner = [ranks](int w, std::int64_t k) {
    return static_cast<int>((w * (k / 3 + 1) + k / 5) % ranks);
  };
  const std::string path = folder.file("run.h5");
  begin_run(world(), sample, path, sample.num_frames)->close(true, "");
  if (world().is_root()) expect_sample(read_whole_run(path), sample, sample.num_frames);
}

TEST(RunFile, lets_ranks_without_a_world_take_part) {
  const SharedFolder folder(world());
  Sample sample = sample_on(world());
  sample.owner = [last = sample.num_ranks - 1](int, std::int64_t) { return last; };
  const std::string path = folder.file("run.h5");
  begin_run(world(), sample, path, sample.num_frames)->close(true, "");
  if (world().is_root()) expect_sample(read_whole_run(path), sample, sample.num_frames);
}

TEST(RunFile, records_bodies_only_every_so_many_frames) {
  for (const int every : {2, 4, 7}) {
    const SharedFolder folder(world());
    Sample sample = sample_on(world());
    sample.record_every = every;
    const std::string path = folder.file("run.h5");
    begin_run(world(), sample, path, sample.num_frames)->close(true, "");
    if (world().is_root()) expect_sample(read_whole_run(path), sample, sample.num_frames);
  }
}

TEST(RunFile, commits_at_every_flush_and_is_readable_before_it_is_closed) {
  const SharedFolder folder(world());
  const Sample sample = sample_on(world());
  const std::string path = folder.file("run.h5");
  const RankWorlds at_start(sample, 0);
  RunSetup setup = sample_setup(sample, at_start, path);
  setup.flush_interval_s = 0;
  RunFile file(group_of(world()), std::move(setup));
  for (std::int64_t k = 0; k < 4; ++k) {
    world().barrier();
    if (world().is_root()) expect_sample(read_whole_run(path), sample, k);
    world().barrier();
    put_frame(file, sample, k);
  }
  file.close(false, "");
}

TEST(RunFile, commits_what_it_holds_before_the_run_is_saved) {
  const SharedFolder folder(world());
  const Sample sample = sample_on(world());
  const std::string path = folder.file("run.h5");
  const RankWorlds at_start(sample, 0);
  RunFile file(group_of(world()), sample_setup(sample, at_start, path));  // which never flushes by itself
  for (std::int64_t k = 0; k < 3; ++k) put_frame(file, sample, k);
  file.secure();
  world().barrier();
  if (world().is_root()) expect_sample(read_whole_run(path), sample, 3);
  world().barrier();
  file.close(false, "");
}

TEST(RunFile, of_a_run_that_goes_on_has_its_own_rows_for_frames_that_keep_their_numbers) {
  const SharedFolder folder(world());
  Sample sample = sample_on(world());
  sample.record_every = 2;
  const std::string path = folder.file("run.h5");
  const RankWorlds at_start(sample, 0);
  RunSetup setup = sample_setup(sample, at_start, path);
  setup.first_frame = 3;
  setup.num_frames = 3;
  RunFile file(group_of(world()), std::move(setup));
  for (std::int64_t k = 3; k < 6; ++k) put_frame(file, sample, k);
  file.close(true, "");
  if (!world().is_root()) return;
  const WholeRun run = read_whole_run(path);
  EXPECT_EQ(run.attributes.at("first_frame"), "3");
  EXPECT_EQ(run.frames_committed, 3);
  EXPECT_EQ(run.frame_wall_s, (std::vector<double>{sample_wall_s(3), sample_wall_s(4), sample_wall_s(5)}));
  ASSERT_EQ(run.position.size(), 1u) << "each second frame of the file";
  EXPECT_EQ(run.position[0][0].x(), sample_position(0, 0, 4, 0));
}

TEST(RunFile, cuts_the_datasets_of_a_run_that_ended_early) {
  const SharedFolder folder(world());
  Sample sample = sample_on(world());
  sample.num_frames = 4000;
  sample.bodies_per_world = 40;  // several chunks per dataset, so that whole chunks are freed
  sample.profile = false;        // its small columns come last and would keep the length, with a hole instead
  const std::string path = folder.file("run.h5");
  const auto file = begin_run(world(), sample, path, 7);
  world().barrier();
  const auto planned = world().is_root() ? std::filesystem::file_size(path) : 0;
  file->close(false, "");
  if (!world().is_root()) return;
  const WholeRun run = read_whole_run(path);
  expect_sample(run, sample, 7);
  EXPECT_FALSE(run.complete);
  EXPECT_LT(std::filesystem::file_size(path), planned);
}

TEST(RunFile, closes_without_a_single_frame) {
  const SharedFolder folder(world());
  const Sample sample = sample_on(world());
  const std::string path = folder.file("run.h5");
  begin_run(world(), sample, path, 0)->close(false, "");
  if (world().is_root()) expect_sample(read_whole_run(path), sample, 0);
}

TEST(RunFile, counts_the_events_for_which_it_has_no_room) {
  const SharedFolder folder(world());
  const Sample sample = sample_on(world());
  const std::string path = folder.file("run.h5");
  const auto file = begin_run(world(), sample, path, 0);
  for (int i = 0; i < 66; ++i) file->event({.frame = i, .kind = "rebalance", .detail = "", .value = 3});
  for (int i = 66; i < 516; ++i) file->event({i, "joint_broken", "é" + std::string(200, 'x')});
  file->close(false, "");
  if (!world().is_root()) return;
  const WholeRun run = read_whole_run(path);
  ASSERT_EQ(run.events.size(), 512u) << "the preallocated rows (io/SCHEMA.md)";
  EXPECT_EQ(run.events[63].kind, "rebalance");
  EXPECT_EQ(run.events[64].frame, 66) << "rebalances leave 448 rows to what happens to worlds";
  EXPECT_EQ(run.events[511].frame, 513);
  EXPECT_EQ(run.events[511].detail, "é" + std::string(158, 'x')) << "cut to the column's 160 bytes";
  EXPECT_EQ(run.num_events.at("joint_broken"), 450) << "of which two have no row";
  EXPECT_EQ(run.num_events.at("rebalance"), 66) << "of which two have no row";
  EXPECT_EQ(run.num_events.at("signal"), 0);
  EXPECT_EQ(run.worlds_moved, 198);
}

TEST(RunFile, replaces_an_older_file_and_follows_a_link_to_it) {
  const SharedFolder folder(world());
  const Sample sample = sample_on(world());
  const std::string path = folder.file("run.h5"), link = folder.file("link.h5");
  begin_run(world(), sample, path, 1)->close(false, "");
  if (world().is_root()) std::filesystem::create_symlink("run.h5", link);
  world().barrier();
  begin_run(world(), sample, link, 2)->close(false, "");
  if (!world().is_root()) return;
  EXPECT_TRUE(std::filesystem::is_symlink(link));
  EXPECT_EQ(read_run(path).frames_committed, 2);
}

TEST(RunFile, is_as_large_as_estimated) {
  const SharedFolder folder(world());
  Sample sample = sample_on(world());
  sample.num_worlds = 100;
  sample.bodies_per_world = 36;
  sample.num_frames = 8;
  sample.contacts = false;  // their number is not known
  const std::string path = folder.file("run.h5");
  begin_run(world(), sample, path, sample.num_frames)->close(true, "");
  if (!world().is_root()) return;
  const auto bytes = static_cast<double>(std::filesystem::file_size(path));
  // The estimate promises 10 %; names and parameters are guessed.
  EXPECT_NEAR(static_cast<double>(estimate_file_bytes({.num_bodies = 3650,
                                                       .num_worlds = 100,
                                                       .num_ranks = sample.num_ranks,
                                                       .num_frames = 8,
                                                       .optional = {.profile = sample.profile,
                                                                    .estimate = true,
                                                                    .residuals = true,
                                                                    .breaks = true,
                                                                    .interest = true},
                                                       .num_geoms = 3750,
                                                       .num_joints = 150})),
              bytes, 0.1 * bytes);
}

}  // namespace
}  // namespace pbmpi::io::test
