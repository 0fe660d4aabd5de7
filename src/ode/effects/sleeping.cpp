#include "ode/effects/sleeping.h"

#include "ode/objects/bodies.h"

namespace pbmpi::ode {

Sleeping::Sleeping(const model::Model& model, double dt_s, const std::vector<dBodyID>& bodies)
    : model_(&model), bodies_(bodies), sleepers_(model, dt_s) {}

void Sleeping::start(const model::State& state) {
  state_ = state;
  sleepers_.start(state_);
  disable_sleepers();
}

void Sleeping::disable_sleepers() {
  for (std::size_t body = 0; body < bodies_.size(); ++body) {
    if (state_.rest[body].asleep()) {
      dBodyDisable(bodies_[body]);
    } else {
      dBodyEnable(bodies_[body]);
    }
  }
}

bool Sleeping::wake(const std::vector<int>& islands) {
  if (!sleepers_.wake(islands, state_)) return false;
  disable_sleepers();
  return true;
}

void Sleeping::wake_called(std::int64_t step) { wake(sleepers_.islands_called(step, state_)); }

const std::vector<GeomPair>& Sleeping::awake_pairs(const std::vector<GeomPair>& pairs) {
  pairs_.clear();
  const auto awake = [&](int geom) {
    const int body = model_->geoms[geom].body;
    return body != model::no_body && !state_.rest[body].asleep();
  };
  for (const GeomPair& pair : pairs) {
    if (awake(pair.first) || awake(pair.second)) pairs_.push_back(pair);
  }
  return pairs_;
}

void Sleeping::take(const std::vector<Touch>& touches) {
  touching_.clear();
  for (const Touch& touch : touches) touching_.emplace_back(touch.body_a, touch.body_b);
}

bool Sleeping::wake_touched(const std::vector<Touch>& touches) {
  take(touches);
  return wake(effects::Sleepers::islands_touched(touching_, state_));
}

void Sleeping::settle(const std::vector<Touch>& touches) {
  copy_out(bodies_, state_);
  take(touches);
  sleepers_.count(sleepers_.awake(), state_);
  const std::vector<effects::Resting> resting = sleepers_.find_resting(sleepers_.awake(), touching_, state_);
  sleepers_.put_to_sleep(resting, state_);
  for (const effects::Resting& one : resting) {
    dBodySetLinearVel(bodies_[one.body], 0, 0, 0);
    dBodySetAngularVel(bodies_[one.body], 0, 0, 0);
    dBodyDisable(bodies_[one.body]);
  }
}

}  // namespace pbmpi::ode
