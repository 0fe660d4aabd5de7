/// A small run in which every number is a function of (world, body, frame), so that each rank can make its
/// part and any reader can check the numbers it finds.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "io/run/run_file.h"
#include "stepping/frame.h"

namespace pbmpi::io::test {

/// Owner of a world in a frame.
using Placement = std::function<int(int world, std::int64_t frame)>;

struct Sample {
  int num_worlds = 5;
  std::int64_t num_frames = 6;
  int record_every = 1;
  int bodies_per_world = 3;  ///< world w has w % 2 more bodies
  int num_ranks = 1;
  int rank = 0;
  bool profile = true;   ///< with step profiles
  bool contacts = true;  ///< with contacts
  Placement owner;       ///< empty: world w belongs to rank w % num_ranks

  int owner_of(int world, std::int64_t frame) const {
    return owner ? owner(world, frame) : world % num_ranks;
  }
};

std::shared_ptr<const model::Model> sample_model(const Sample& sample, int world);
model::State sample_state(const Sample& sample, int world, std::int64_t frame);
stepping::Observables sample_observables(int world, std::int64_t frame);
/// The first body is one island, and the others are another.
stepping::StepProfile sample_profile(const Sample& sample, int world, std::int64_t frame);
/// (world + frame) % 4 contacts; the numbers of contact i are 1/16 of (world, frame, i), see the source.
stepping::StepContacts sample_contacts(const Sample& sample, int world, std::int64_t frame);
double sample_wall_s(std::int64_t frame);
/// Seconds of a phase of a rank.
double sample_phase_s(int rank, int phase, std::int64_t frame);
/// One component of a body's position [m].
double sample_position(int world, int body, std::int64_t frame, int axis);

/// The worlds of this rank in a frame, with all that LocalWorld points to.
struct RankWorlds {
  RankWorlds(const Sample& sample, std::int64_t frame);
  std::vector<std::shared_ptr<const model::Model>> models;
  std::vector<model::State> states;
  std::vector<stepping::Observables> observables;
  std::vector<stepping::StepProfile> profiles;
  std::vector<stepping::StepContacts> contacts;
  std::vector<stepping::LocalWorld> worlds;
};

/// The setup of a RunFile, which flushes only when it is closed unless flush_interval_s is changed.
RunSetup sample_setup(const Sample& sample, const RankWorlds& at_start, const std::string& path);

/// Hands frame `frame` to the file.
void put_frame(RunFile& file, const Sample& sample, std::int64_t frame);

}  // namespace pbmpi::io::test
