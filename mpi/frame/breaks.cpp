#include "mpi/frame/breaks.h"

#include <algorithm>
#include <array>
#include <tuple>

namespace pbmpi::mpi {
namespace {

/// A broken joint as it is sent. Longer names are cut.
struct Break {
  std::int32_t step = 0, world = 0, joint = 0;
  std::array<char, 100> name{};
};

Break make_break(const stepping::LocalWorld& world, std::size_t joint) {
  Break found{world.state->broken_in[joint], world.id, static_cast<std::int32_t>(joint), {}};
  const std::string& name = world.model->joints[joint].name;
  std::copy_n(name.begin(), std::min(name.size(), found.name.size() - 1), found.name.begin());
  return found;
}

}  // namespace

bool any_breakage(const Communicator& comm, std::span<const stepping::LocalWorld> worlds) {
  std::int64_t any = 0;
  for (const stepping::LocalWorld& world : worlds) any |= world.state->broken_in.empty() ? 0 : 1;
  comm.allreduce(std::span(&any, 1), Reduce::max);
  return any != 0;
}

std::vector<stepping::RunEvent> find_breaks(const Communicator& comm,
                                            std::span<const stepping::LocalWorld> worlds, int first_world,
                                            std::int64_t frame, std::int64_t first_step) {
  std::vector<Break> breaks;
  for (const stepping::LocalWorld& world : worlds) {
    for (std::size_t joint = 0; joint < world.state->broken_in.size(); ++joint) {
      if (world.state->broken_in[joint] >= first_step) breaks.push_back(make_break(world, joint));
    }
  }
  breaks = comm.allgatherv(std::span<const Break>(breaks));
  const auto key = [](const Break& one) { return std::tuple(one.step, one.world, one.joint); };
  std::sort(breaks.begin(), breaks.end(), [&](const Break& a, const Break& b) { return key(a) < key(b); });
  std::vector<stepping::RunEvent> events;
  for (const Break& one : breaks) {
    const std::string name = one.name.data();
    events.push_back({.frame = frame,
                      .kind = stepping::event_kind::joint_broken,
                      .detail = "world " + std::to_string(first_world + one.world) + ": '" + name +
                                "' broke in step " + std::to_string(one.step),
                      .step = one.step,
                      .world = one.world,
                      .joint = one.joint,
                      .name = name});
  }
  return events;
}

}  // namespace pbmpi::mpi
