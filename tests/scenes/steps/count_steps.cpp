// count_steps SCENE quick|sor [+EFFECT,-EFFECT]: steps world 0 of a scene. For callgrind, which counts only
// in counted_steps() or, as a check of the counting, in counted_plan().
#include <malloc.h>

#include <cstdint>
#include <cstdio>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "core/error.h"
#include "core/hash.h"
#include "effects/effect_choices.h"
#include "effects/effects.h"
#include "model/names.h"
#include "model/state.h"
#include "ode/collide/narrow_phase.h"
#include "ode/ode_stepper.h"
#include "scenes/scene.h"
#include "solver/worlds/sor_stepper.h"
#include "stepping/names.h"
#include "stepping/step_options.h"

using namespace pbmpi;

constexpr int warmup_steps = 9, num_steps = 15;

// Not in the unnamed namespace, because callgrind is told their names.
[[gnu::noinline]] void counted_steps(stepping::WorldStepper& stepper) {
  core::PhaseTimes times;
  stepper.advance(num_steps, times);
}

/// Goes through the registry once. Returns the number of passes.
[[gnu::noinline]] std::size_t counted_plan(const model::Model& model) {
  return effects::StepPlan(model).passes().size();
}

namespace {

/// How malloc finds a block, and whether a copy takes its slow path, depend on the addresses of blocks. A
/// longer registry in one program than in the other must not change this: freed memory is used up, the
/// registry is made, and everything after it starts at a multiple of 64 KiB.
void put_the_registry_out_of_the_way() {
  static std::vector<std::unique_ptr<char[]>> kept;
  kept.reserve(1 << 12);
  mallopt(M_TOP_PAD, 1 << 28);  // the heap is extended only once
  for (std::size_t size = 8; size < 4096; size += 16) {
    for (int i = 0; i < 10; ++i) kept.push_back(std::make_unique<char[]>(size));
  }
  effects::effect_registry();
  kept.push_back(std::make_unique<char[]>(1));
  constexpr std::size_t boundary = 1 << 16;
  const std::size_t left = boundary - reinterpret_cast<std::uintptr_t>(kept.back().get()) % boundary;
  kept.push_back(std::make_unique<char[]>(left + boundary / 2));
}

std::unique_ptr<stepping::WorldStepper> make_stepper(const std::string& name) {
  const auto kind = model::enum_from_name<stepping::StepperKind>(name, stepping::stepper_kind_names);
  core::require_input(kind.has_value(), name + ": no stepper");
  const stepping::StepperSettings settings = stepping::default_settings(*kind);
  if (kind == stepping::StepperKind::sor) return solver::make_sor_stepper(settings, ode::make_narrow_phase);
  return ode::make_ode_stepper(settings, [](const std::string&) {});
}

void run(const std::string& scene, const std::string& stepper_name, const std::string& choices) {
  const auto parsed =
      scenes::parse_scene(scenes::find_scene(scene), std::nullopt, effects::parse_effect_choices(choices));
  const auto model = parsed->build(0, 1);
  const auto stepper = make_stepper(stepper_name);
  const model::State start = model::initial_state(*model);
  stepper->add(0, model, start, 0);
  core::PhaseTimes times;
  stepper->advance(warmup_steps, times);
  counted_steps(*stepper);
  std::printf("{\"effects\": %zu, \"passes\": %zu, \"steps\": %d, \"state_hash\": \"%s\"}\n",
              effects::effect_registry().size(), counted_plan(*model), num_steps,
              core::to_hex(model::hash(stepper->state(0))).c_str());
}

}  // namespace

int main(int argc, char** argv) {
  try {
    core::require_input(argc == 3 || argc == 4, "usage: count_steps SCENE quick|sor [+EFFECT,-EFFECT]");
    put_the_registry_out_of_the_way();
    run(argv[1], argv[2], argc == 4 ? argv[3] : "");
  } catch (const std::exception& error) {
    std::fprintf(stderr, "count_steps: %s\n", error.what());
    return static_cast<int>(core::ExitCode::bad_input);
  }
}
