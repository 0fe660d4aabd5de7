#include "mpi/frame/world_events.h"

#include <algorithm>
#include <array>
#include <string>
#include <tuple>

namespace pbmpi::mpi {
namespace {

/// A stepping::RunEvent as it is sent. Longer texts are cut.
struct WireEvent {
  std::int64_t step = -1;
  double value = 0;
  std::int32_t world = -1, joint = -1;
  std::array<char, 24> kind{};
  std::array<char, 104> name{};
  std::array<char, 168> detail{};
};

template <std::size_t N>
void put(const std::string& text, std::array<char, N>& to) {
  std::copy_n(text.begin(), std::min(text.size(), N - 1), to.begin());
}

WireEvent to_wire(const stepping::RunEvent& event) {
  WireEvent wire;
  wire.step = event.step;
  wire.value = event.value;
  wire.world = event.world;
  wire.joint = event.joint;
  put(event.kind, wire.kind);
  put(event.name, wire.name);
  put(event.detail, wire.detail);
  return wire;
}

stepping::RunEvent from_wire(const WireEvent& wire, std::int64_t frame) {
  return {.frame = frame,
          .kind = wire.kind.data(),
          .detail = wire.detail.data(),
          .step = wire.step,
          .world = wire.world,
          .joint = wire.joint,
          .name = wire.name.data(),
          .value = wire.value};
}

}  // namespace

std::vector<stepping::RunEvent> share_events(const Communicator& comm,
                                             std::span<const stepping::RunEvent> own, std::int64_t frame) {
  std::vector<WireEvent> mine;
  for (const stepping::RunEvent& event : own) mine.push_back(to_wire(event));
  std::vector<WireEvent> all = comm.allgatherv(std::span<const WireEvent>(mine));
  std::ranges::stable_sort(all, {}, [](const WireEvent& one) { return std::tuple(one.step, one.world); });
  std::vector<stepping::RunEvent> events;
  events.reserve(all.size());
  for (const WireEvent& one : all) events.push_back(from_wire(one, frame));
  return events;
}

bool any_breakage(const Communicator& comm, std::span<const stepping::LocalWorld> worlds) {
  std::int64_t any = 0;
  for (const stepping::LocalWorld& world : worlds) any |= world.state->broken_in.empty() ? 0 : 1;
  comm.allreduce(std::span(&any, 1), Reduce::max);
  return any != 0;
}

std::vector<stepping::RunEvent> find_breaks(const Communicator& comm,
                                            std::span<const stepping::LocalWorld> worlds, int first_world,
                                            std::int64_t frame, std::int64_t first_step) {
  std::vector<stepping::RunEvent> own;
  for (const stepping::LocalWorld& world : worlds) {
    for (std::size_t joint = 0; joint < world.state->broken_in.size(); ++joint) {
      const std::int32_t step = world.state->broken_in[joint];
      if (step < first_step) continue;
      const std::string& name = world.model->joints[joint].name;
      own.push_back({.kind = stepping::event_kind::joint_broken,
                     .detail = "world " + std::to_string(first_world + world.id) + ": '" + name +
                               "' broke in step " + std::to_string(step),
                     .step = step,
                     .world = world.id,
                     .joint = static_cast<int>(joint),
                     .name = name});
    }
  }
  return share_events(comm, own, frame);
}

}  // namespace pbmpi::mpi
