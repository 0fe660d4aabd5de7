#include "spaces.h"

#include <cstdio>

#include "core/clock.h"
#include "core/statistics.h"
#include "ode/collide/broad_phase.h"
#include "ode/objects/bodies.h"
#include "ode/objects/engine.h"
#include "support/models.h"

namespace pbmpi::bench {
namespace {

/// Boxes in a square on the ground, close enough for neighbours to touch.
model::Model field(int num_boxes) {
  model::Model model = support::pile(num_boxes);
  int side = 1;
  while (side * side < num_boxes) ++side;
  for (int i = 0; i < num_boxes; ++i) {
    model.bodies[static_cast<std::size_t>(i)].pose.position = {0.6 * (i % side), 0.6 * (i / side), 0.3};
  }
  return model;
}

/// Median time of find_pairs() in seconds when all bodies have moved.
double time_find_pairs(const model::Model& model, ode::SpaceKind kind, std::size_t& num_pairs) {
  const ode::WorldHandle world(dWorldCreate());
  const auto bodies = ode::make_bodies(world.get(), model);
  ode::BroadPhase broad(model, bodies, kind);
  const model::State state = model::initial_state(model);
  std::vector<double> seconds;
  for (int repeat = 0; repeat < 201; ++repeat) {
    ode::restore(bodies, state);
    const double start_s = core::now_s();
    num_pairs = broad.find_pairs().size();
    seconds.push_back(core::now_s() - start_s);
  }
  return core::quantile(seconds, 0.5);
}

void print(const char* name, const model::Model& model) {
  std::size_t num_pairs = 0;
  const double simple_s = time_find_pairs(model, ode::SpaceKind::simple, num_pairs);
  const double sweep_s = time_find_pairs(model, ode::SpaceKind::sweep_and_prune, num_pairs);
  std::printf("%-6s %6zu geoms %6zu pairs  simple %9.2f us  sweep-and-prune %9.2f us\n", name,
              model.geoms.size(), num_pairs, 1e6 * simple_s, 1e6 * sweep_s);
}

}  // namespace

void compare_spaces() {
  const ode::Engine engine;
  for (const int num_boxes : {4, 8, 16, 24, 32, 48, 64, 96, 128, 256, 512}) {
    print("pile", support::pile(num_boxes));
    print("field", field(num_boxes));
  }
  print("crash", support::crash());
}

}  // namespace pbmpi::bench
