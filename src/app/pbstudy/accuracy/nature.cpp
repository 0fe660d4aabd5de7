#include "app/pbstudy/accuracy/nature.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <memory>

#include "core/clock.h"
#include "core/statistics.h"

namespace pbmpi::app {
namespace {

using analysis::PoseErrors;

/// Does frames of a scene by one way, with any number of steps.
class WayStepper {
 public:
  WayStepper(Way way, const StudyScene& scene, const NatureLimits& limits, const NatureListener& tell)
      : way_(way), scene_(scene), limits_(limits), tell_(tell) {}

  /// A frame from `start`, with ever more steps until twice as many move little, or more are not allowed.
  WayEnds advance(const States& start, int frame) {
    int steps = scene_.steps_per_frame();
    WayEnds ends{steps, {}, run(start, frame, steps)};
    while (2 * steps <= limits_.most_steps) {
      steps *= 2;
      ends = {steps, std::move(ends.finer), run(start, frame, steps)};
      if (core::quantile(distances_m(ends.coarser, ends.finer), nine_tenths) < limits_.error_m) break;
    }
    return ends;
  }

 private:
  static constexpr double nine_tenths = 0.9;

  States run(const States& start, int frame, int steps) {
    if (tell_) tell_(frame, steps);
    std::unique_ptr<CaseStepper>& stepper = steppers_[steps];
    if (!stepper) {
      const stepping::StepperSettings settings = settings_of(way_, scene_.frame_s / steps, limits_);
      stepper =
          std::make_unique<CaseStepper>(build_worlds(scene_, settings.dt_s, limits_.seed), settings, steps);
    }
    stepper->start_from(start, frame);
    stepper->advance_frame();
    return stepper->states();
  }

  Way way_;
  const StudyScene& scene_;
  const NatureLimits& limits_;
  const NatureListener& tell_;
  std::map<int, std::unique_ptr<CaseStepper>> steppers_;  ///< by steps of a frame
};

/// NaN if any is.
void raise_all(const std::vector<double>& by, std::vector<double>& most) {
  std::transform(most.begin(), most.end(), by.begin(), most.begin(),
                 [](double a, double b) { return std::isnan(b) || b > a ? b : a; });
}

/// Of one world.
PoseErrors uncertainty_of(const model::Model& model, const NatureFrame& frame, std::size_t world) {
  const auto distance = [&](const States& a, const States& b) {
    return analysis::compare(model, view_of(a[world]), view_of(b[world]));
  };
  PoseErrors most = distance(frame.by(Way::soft).finer, frame.by(Way::ode).finer);
  for (const WayEnds& way : frame.ways) {
    const PoseErrors moved = distance(way.coarser, way.finer);
    raise_all(moved.body_position_m, most.body_position_m);
    raise_all(moved.body_orientation_rad, most.body_orientation_rad);
  }
  return most;
}

}  // namespace

stepping::StepperSettings settings_of(Way way, double dt_s, const NatureLimits& limits) {
  stepping::StepperSettings settings;
  settings.dt_s = dt_s;
  settings.seed = limits.seed;
  settings.substeps = 1;
  if (way == Way::soft) return settings;
  settings.law = stepping::ode_law();
  settings.law.friction = stepping::Friction::cone;
  settings.iterations = limits.ode_sweeps;
  return settings;
}

stepping::StepperSettings resting_settings(const StudyScene& scene, const NatureLimits& limits) {
  return settings_of(Way::soft, scene.dt_s / 16, limits);
}

std::vector<double> distances_m(const States& a, const States& b) {
  std::vector<double> distances;
  for (std::size_t world = 0; world < a.size(); ++world) {
    for (std::size_t body = 0; body < a[world].position.size(); ++body) {
      const double distance_m = (a[world].position[body] - b[world].position[body]).norm();
      distances.push_back(std::isnan(distance_m) ? INFINITY : distance_m);
    }
  }
  return distances;
}

Nature find_nature(const StudyScene& scene, const NatureLimits& limits, const NatureListener& tell) {
  Nature nature;
  nature.worlds = build_worlds(scene, scene.dt_s, limits.seed);
  nature.states.emplace_back();
  for (const auto& model : nature.worlds) nature.states.back().push_back(model::initial_state(*model));
  WayStepper soft(Way::soft, scene, limits, tell), ode(Way::ode, scene, limits, tell);
  for (int frame = 0; frame < scene.total_frames(); ++frame) {
    const double start_s = core::thread_cpu_s();
    NatureFrame found;
    found.ways[0] = soft.advance(nature.states.back(), frame);
    if (frame >= scene.warmup) {
      found.ways[1] = ode.advance(nature.states.back(), frame);
      for (std::size_t world = 0; world < nature.worlds.size(); ++world)
        found.uncertainty.push_back(uncertainty_of(*nature.worlds[world], found, world));
      found.cpu_s = core::thread_cpu_s() - start_s;
    }
    nature.states.push_back(found.by(Way::soft).finer);
    if (frame >= scene.warmup) nature.frames.push_back(std::move(found));
  }
  return nature;
}

void keep_judged(const model::Model& model, const PoseErrors& uncertainty, PoseErrors& errors) {
  const auto is_judged = [&](int body) {
    return body == model::no_body || uncertainty.body_position_m[static_cast<std::size_t>(body)] < judged_m;
  };
  PoseErrors kept;
  kept.broken_joints = errors.broken_joints;
  for (int body = 0; body < model.num_bodies(); ++body) {
    const double error_m = errors.body_position_m[static_cast<std::size_t>(body)];
    if (!is_judged(body) && std::isfinite(error_m)) continue;
    kept.body_position_m.push_back(errors.body_position_m[static_cast<std::size_t>(body)]);
    kept.body_orientation_rad.push_back(errors.body_orientation_rad[static_cast<std::size_t>(body)]);
  }
  for (std::size_t i = 0; i < errors.joints.size(); ++i) {
    const model::Joint& joint = model.joints[errors.joints[i]];
    if (!is_judged(joint.body_a) || !is_judged(joint.body_b)) continue;
    kept.joints.push_back(errors.joints[i]);
    kept.joint_position_m.push_back(errors.joint_position_m[i]);
    kept.joint_orientation_rad.push_back(errors.joint_orientation_rad[i]);
  }
  errors = std::move(kept);
}

void WithinCounts::count(const PoseErrors& uncertainty, const PoseErrors& errors) {
  for (std::size_t body = 0; body < errors.body_position_m.size(); ++body) {
    ++bodies;
    for (std::size_t i = 0; i < asked_m.size(); ++i) {
      if (!(uncertainty.body_position_m[body] < known_share * asked_m[i])) continue;
      ++determined[i];
      if (errors.body_position_m[body] < asked_m[i]) ++within[i];
    }
  }
}

std::array<double, asked_m.size()> WithinCounts::determined_shares() const {
  std::array<double, asked_m.size()> shares{};
  for (std::size_t i = 0; i < shares.size(); ++i)
    shares[i] = static_cast<double>(determined[i]) / static_cast<double>(bodies);
  return shares;
}

std::array<double, asked_m.size()> WithinCounts::within_shares() const {
  std::array<double, asked_m.size()> shares{};
  for (std::size_t i = 0; i < shares.size(); ++i)
    shares[i] =
        determined[i] == 0 ? NAN : static_cast<double>(within[i]) / static_cast<double>(determined[i]);
  return shares;
}

}  // namespace pbmpi::app
