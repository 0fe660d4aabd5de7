#include "model/effects.h"

#include <algorithm>

#include "core/error.h"

namespace pbmpi::model {
namespace {

using core::Phase;

/// "3 geoms with mu > 0", or nothing for none.
std::optional<std::string> counted(std::ptrdiff_t count, std::string_view what) {
  if (count == 0) return std::nullopt;
  return std::to_string(count) + " " + std::string(what);
}

template <class Items, class Predicate>
std::optional<std::string> counted_if(const Items& items, Predicate predicate, std::string_view what) {
  return counted(std::count_if(items.begin(), items.end(), predicate), what);
}

template <class Predicate>
std::optional<std::string> counted_events(const Model& model, Predicate predicate, std::string_view what) {
  return counted_if(model.events, predicate, what);
}

std::optional<std::string> gravity(const Model& model) {
  if (model.gravity.isZero()) return std::nullopt;
  return "gravity of " + std::to_string(model.gravity.norm()).substr(0, 5) + " m/s^2";
}

std::optional<std::string> collision(const Model& model) {
  const bool moving =
      std::any_of(model.geoms.begin(), model.geoms.end(), [](const Geom& g) { return g.body != no_body; });
  if (!moving || model.geoms.size() < 2) return std::nullopt;
  return counted(static_cast<std::ptrdiff_t>(model.geoms.size()), "geoms");
}

std::optional<std::string> friction(const Model& model) {
  if (!collision(model)) return std::nullopt;
  return counted_if(
      model.geoms, [](const Geom& g) { return g.material.mu > 0; }, "geoms with mu > 0");
}

std::optional<std::string> restitution(const Model& model) {
  if (!collision(model)) return std::nullopt;
  return counted_if(
      model.geoms, [](const Geom& g) { return g.material.restitution > 0; }, "geoms with restitution > 0");
}

std::optional<std::string> joints(const Model& model) {
  return counted(static_cast<std::ptrdiff_t>(model.joints.size()), "joints");
}

std::optional<std::string> limits(const Model& model) {
  return counted_if(
      model.joints, [](const Joint& j) { return j.limits[0].active() || j.limits[1].active(); },
      "joints with a limit");
}

std::optional<std::string> motors(const Model& model) {
  const auto has_motor = [](const Joint& j) { return j.motors[0].active() || j.motors[1].active(); };
  if (auto reason = counted_if(model.joints, has_motor, "joints with a motor")) return reason;
  return counted_events(
      model, [](const Event& e) { return e.kind == EventKind::motor; }, "motor events");
}

std::optional<std::string> suspension(const Model& model) {
  return counted_if(
      model.joints, [](const Joint& j) { return j.suspension.stiffness > 0; }, "joints with a spring");
}

std::optional<std::string> steering(const Model& model) {
  return counted_events(
      model, [](const Event& e) { return e.kind == EventKind::steer; }, "steering events");
}

std::optional<std::string> launches(const Model& model) {
  return counted_events(
      model, [](const Event& e) { return e.kind == EventKind::launch; }, "launches");
}

}  // namespace

const std::vector<Effect>& effect_registry() {
  static const std::vector<Effect> effects = {
      {"events", "bodies are launched at given steps", Phase::integrate, launches},
      {"steering", "joint axes are pinned to angles at given steps", Phase::integrate, steering},
      {"collision", "geoms that touch get contacts", Phase::collide, collision},
      {"friction", "contacts resist sliding (Coulomb, box friction)", Phase::rows, friction},
      {"restitution", "contacts bounce", Phase::rows, restitution},
      {"joints", "bodies are held together", Phase::rows, joints},
      {"limits", "joint angles stay in their range", Phase::rows, limits},
      {"motors", "joint axes are driven or held", Phase::rows, motors},
      {"suspension", "wheels spring along the steering axis", Phase::rows, suspension},
      {"gravity", "bodies fall", Phase::integrate, gravity},
  };
  return effects;
}

StepPlan::StepPlan(const Model& model) {
  for (const Effect& effect : effect_registry()) {
    if (auto reason = effect.reason(model)) passes_.push_back({&effect, *reason});
  }
}

bool StepPlan::has(std::string_view effect) const {
  const auto& registry = effect_registry();
  core::require_invariant(
      std::any_of(registry.begin(), registry.end(), [&](const Effect& e) { return e.name == effect; }),
      "StepPlan::has() of a name that is not in the registry");
  return std::any_of(passes_.begin(), passes_.end(), [&](const Pass& p) { return p.effect->name == effect; });
}

}  // namespace pbmpi::model
