#include "app/pbstudy/stability/stability_cases.h"

#include <cmath>

#include "core/error.h"
#include "engines/optional_engines.h"
#include "model/space_map.h"
#include "stepping/stepper_traits.h"

namespace pbmpi::app {
namespace {

using stepping::StepperKind;

/// The most bodies for a dense solve in reasonable time: its cost is cubic in the rows.
constexpr int most_bodies_of_direct = 45;

std::string why_not(const StabilityCase& one, const HardScene& hard, double most_work) {
  if (static_cast<double>(one.num_steps) * one.num_bodies > most_work) return "left out by --most-work";
  if (one.stepper.kind == StepperKind::direct && one.num_bodies > most_bodies_of_direct)
    return "direct takes time of third order: more than " + std::to_string(most_bodies_of_direct) + " bodies";
  if (one.cut && model::make_space_map(*hard.model).num_units() < 2)
    return "joints hold all bodies together: there is nothing to cut";
  const std::vector<std::string> refused = engines::refusals(one.stepper.kind, *hard.model);
  if (!refused.empty()) return refused.front();
  return {};
}

}  // namespace

std::int64_t HardScene::num_steps() const { return std::llround(hard_case.seconds / dt_s); }

HardScene build_hard_scene(const StudyScene& scene, double dt_s, std::uint64_t seed) {
  const auto parsed = scenes::parse_scene(scene.source, dt_s);
  core::require_input(parsed->hard_case().has_value(),
                      "--scene " + scene.source.name +
                          ": it has no [case], so that nothing says what should happen; add one "
                          "(scenes/FORMAT.md)");
  return {parsed->build(0, seed), *parsed->hard_case(), dt_s};
}

std::vector<StabilityCase> make_stability_cases(const std::vector<StudyScene>& scenes,
                                                const StabilityOptions& options) {
  std::vector<StabilityCase> cases;
  for (std::size_t i = 0; i < scenes.size(); ++i) {
    const HardScene hard = build_hard_scene(scenes[i], scenes[i].dt_s, options.seed);
    for (std::size_t k = 0; k < options.settings.size(); ++k) {
      const StabilitySetting& setting = options.settings[k];
      StabilityCase one;
      one.scene = static_cast<int>(i);
      one.setting = static_cast<int>(k);
      one.stepper = setting.stepper;
      if (!setting.own_dt) one.stepper.dt_s = scenes[i].dt_s;
      one.stepper.seed = options.seed;
      one.cut = setting.cut;
      one.num_steps = std::llround(hard.hard_case.seconds / one.stepper.dt_s);
      one.num_bodies = hard.model->num_bodies();
      one.not_applicable = why_not(one, hard, options.most_work);
      cases.push_back(std::move(one));
    }
  }
  return cases;
}

double cost_of(const StabilityCase& one) {
  if (!one.not_applicable.empty()) return 0;
  const stepping::StepperTraits& traits = traits_of(one.stepper.kind);
  const double bodies = one.num_bodies;
  const double sweeps = sweeps_of(one.stepper);
  const double step = one.stepper.kind == StepperKind::direct ? traits.relative_cost * std::pow(bodies, 3)
                                                              : traits.relative_cost * (sweeps + 5) * bodies;
  return step * static_cast<double>(one.num_steps);
}

}  // namespace pbmpi::app
