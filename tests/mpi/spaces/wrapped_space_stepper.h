/// A stepper that wraps another one; tests override what they change.
#pragma once

#include <memory>
#include <span>
#include <utility>
#include <vector>

#include "stepping/space_stepper.h"

namespace pbmpi::testing_support {

/// Forwards the functions that every stepper has; lacks those that only some have.
class WrappedSpaceStepper : public stepping::SpaceStepper {
 public:
  explicit WrappedSpaceStepper(std::unique_ptr<stepping::SpaceStepper> inner) : inner_(std::move(inner)) {}

  const model::Model& model() const override { return inner_->model(); }
  const model::SpaceMap& map() const override { return inner_->map(); }
  const model::State& state() const override { return inner_->state(); }
  int num_lanes() const override { return inner_->num_lanes(); }
  void own(std::span<const int> spaces, const model::State& state, std::int64_t step) override {
    inner_->own(spaces, state, step);
  }
  void put_states(std::span<const int> bodies, std::span<const double> rows) override {
    inner_->put_states(bodies, rows);
  }
  void fire_events(std::int64_t step) override { inner_->fire_events(step); }
  void launch_others(std::int64_t step) override { inner_->launch_others(step); }
  void collide(std::vector<model::Contact>& contacts) override { inner_->collide(contacts); }
  std::vector<geometry::Box> space_boxes(std::span<const int> spaces) override {
    return inner_->space_boxes(spaces);
  }
  std::vector<int> near_spaces(std::span<const int> owner, std::span<const geometry::Box> boxes) override {
    return inner_->near_spaces(owner, boxes);
  }
  void collide_across(std::span<const int> owner, std::span<const geometry::Box> boxes,
                      std::vector<model::Contact>& contacts) override {
    inner_->collide_across(owner, boxes, contacts);
  }
  void solve(std::span<const int> units, std::span<const model::Contact> contacts, std::int64_t step,
             core::PhaseTimes& times) override {
    inner_->solve(units, contacts, step, times);
  }
  stepping::Observables count(std::span<const int> units) const override { return inner_->count(units); }

 protected:
  stepping::SpaceStepper& inner() { return *inner_; }
  const stepping::SpaceStepper& inner() const { return *inner_; }

 private:
  std::unique_ptr<stepping::SpaceStepper> inner_;
};

}  // namespace pbmpi::testing_support
