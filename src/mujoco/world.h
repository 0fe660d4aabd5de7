/// One world, stepped by MuJoCo.
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "mujoco/compiled.h"
#include "mujoco/drives.h"
#include "stepping/engine/engine_world.h"

namespace pbmpi::mujoco {

/// Its state is the model's: MuJoCo's coordinates are computed from it anew in each step, and its solver
/// starts cold, so that a world that continues and one that is restored have the same bits.
class World final : public stepping::EngineWorld {
 public:
  /// `model` and `targets` are borrowed. Throws core::InputError for a world that MuJoCo refuses. Needs a
  /// MessageScope, as do set_state() and advance().
  World(const model::Model& model, stepping::MotorTargets& targets, const model::State& state,
        std::int64_t step, const stepping::StepperSettings& settings);

  void set_state(const model::State& state) override;
  void aim(const stepping::MotorTargets::Target& target) override;
  void advance(int num_steps, core::LapTimer& timer) override;
  void read(model::State& state, stepping::Observables& observables) override;

 private:
  void fire_events(std::int64_t step) override;
  void store(std::span<const int> bodies, model::State& state) const override;
  void set_velocities(std::span<const int> bodies, const model::State& state) override;
  bool may_be_fast() const override { return false; }
  void add_speculative_contacts(effects::FastBodies&, const model::State&) override {}
  std::span<const effects::BodyPair> touching() override { return {}; }
  effects::Reaction reaction(int joint) const override { return compiled_->loads.reaction(joint); }
  bool is_driven(int) const override { return false; }  ///< asked for by sleeping alone, which is refused
  void show_awake() override {}
  void show_asleep(std::span<const int>) override {}
  /// Makes the next step use another tree.
  void show_broken() override { compiled_.reset(); }

  void compile();
  void take_step(bool is_last, core::LapTimer& timer);
  bool solve_step(int parts, bool is_last, core::LapTimer& timer);
  bool solve_parts(int parts, bool is_last, core::LapTimer& timer);
  bool solve_part(bool is_last, core::LapTimer& timer);
  void collide();
  void solve();
  void show_contacts();
  void take_in_solution();
  void lose();

  int num_parts_;                            ///< fewest MuJoCo steps in a step
  stepping::StepperSettings part_settings_;  ///< settings of one of these steps
  Drives drives_;
  model::State after_;                  ///< scratch of take_step()
  bool measures_loads_;                 ///< do joints break under load, or are forces shown?
  double kept_linear_, kept_angular_;   ///< factors that a step's damping applies to the velocities
  std::unique_ptr<Compiled> compiled_;  ///< none once different joints hold
  std::vector<mjtNum> qpos_;            ///< scratch of collide()
};

}  // namespace pbmpi::mujoco
