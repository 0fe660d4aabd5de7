/// The pack itself, for one number type and number of lanes. Compiled once for each instruction set.
#pragma once

#include <optional>

#include "solver/layout/pack_laws.h"
#include "solver/pack/collider_lanes.h"
#include "solver/pack/speed_bounds.h"
#include "solver/pack/step_lanes.h"

namespace pbmpi::solver {

template <class T>
class PackLanes final : public Pack {
 public:
  explicit PackLanes(std::span<const PackedWorld> worlds)
      : passes_(shared_passes(worlds)),
        worlds_(worlds, passes_),
        step_(laws_of(*worlds.front().model), passes_, worlds_) {
    if (passes_.collision) collider_.emplace(worlds, worlds_, passes_.sleeping);
    if (passes_.fast_bodies) speed_bounds_.emplace(worlds_, worlds);
  }

  void load(int world, const model::State& state) override {
    worlds_.load(world, state);
    if (collider_) collider_->forget_boxes();
  }
  void store(int world, model::State& state) const override { worlds_.store(world, state); }
  void load(int world, std::span<const int> bodies, const model::State& state) override {
    for (const int body : bodies) worlds_.load_body(world, body, state);
    if (collider_) collider_->forget_boxes();
  }
  void store(int world, std::span<const int> bodies, model::State& state) const override {
    for (const int body : bodies) worlds_.store_body(world, body, state);
  }
  void set_active(int world, std::span<const int> bodies) override { worlds_.set_active(world, bodies); }
  void set_awake(int world, std::span<const int> bodies) override { worlds_.set_awake(world, bodies); }
  void set_motor(int world, int joint, int axis, const model::AxisMotor& motor) override {
    worlds_.set_motor(world, joint, axis, motor);
  }
  void set_limit(int world, int joint, int axis, const model::AxisLimit& limit) override {
    worlds_.set_limit(world, joint, axis, limit);
  }
  void launch(int world, const model::Event& event) override { worlds_.launch(world, event); }
  void set_load(int world, int body, const stepping::BodyLoad& load) override {
    worlds_.set_load(world, body, load);
  }
  void forget(int world, int body) override { worlds_.forget(world, body); }
  void set_broken(int world, std::span<const std::int32_t> broken_in) override {
    if (worlds_.set_broken(world, broken_in) && collider_) collider_->set_broken(world, broken_in);
  }
  effects::Reaction reaction(int world, int joint) const override {
    return worlds_.reaction(world, joint, step_.h());
  }
  model::Vec3 centre(int world, int body) const override { return worlds_.centre(world, body); }
  void find_fast(double dt_s, std::vector<char>& may_be_fast) const override {
    may_be_fast.assign(static_cast<std::size_t>(worlds_.num_worlds()), 0);
    if (speed_bounds_) speed_bounds_->find_fast(worlds_, dt_s, may_be_fast);
  }
  void find_slow(double dt_s, double way_m, std::vector<char>& may_be_slow) const override {
    may_be_slow.assign(static_cast<std::size_t>(worlds_.num_worlds()), 0);
    solver::find_slow(worlds_, dt_s, way_m, may_be_slow);
  }
  void poses(int world, std::span<model::BodyPose> poses) const override { worlds_.poses(world, poses); }
  int joint_rows(int world, int joint) const override { return worlds_.joint_rows(world, joint); }

  void collide(std::span<std::vector<model::Contact>> contacts) override {
    if (collider_) collider_->collide(worlds_, contacts);
  }
  void collide_pairs(int world, std::span<const model::GeomPair> pairs,
                     std::vector<model::Contact>& contacts) override {
    if (collider_) collider_->collide_pairs(worlds_, world, pairs, contacts);
  }
  void step(Contacts contacts, const StepParameters& parameters, RenewedContacts* renewed,
            core::PhaseTimes& times) override {
    step_.run(contacts, parameters, renewed, times);
  }
  stepping::Residuals residuals(int world) const override { return step_.residuals(world); }

 private:
  Passes passes_;
  WorldLanes<T> worlds_;
  StepLanes<T> step_;
  std::optional<ColliderLanes<T>> collider_;    ///< none without the pass "collision"
  std::optional<SpeedBounds<T>> speed_bounds_;  ///< none without the pass "fast_bodies"
};

}  // namespace pbmpi::solver
