#include "app/pbstudy/effects/effects_cases.h"

#include <algorithm>
#include <array>

#include "core/error.h"
#include "effects/effect_choices.h"
#include "effects/effects.h"
#include "effects/run_plan.h"

namespace pbmpi::app {
namespace {

namespace po = boost::program_options;

/// In the order in which cases are crossed, the last varying fastest.
constexpr std::array<VariedOption, 2> varied = {{
    {"stepper", "quick, direct, sor, bullet, mujoco; default: quick sor", "quick sor"},
    {"precision", "sor: double, single; default: double", "double"},
}};

po::options_description options_description() {
  po::options_description what("What to measure (lists, separated by blanks)");
  add_scene_option(what);
  what.add_options()("effect", list_of<std::string>(), "effects; default: all (pbmpi --describe)");
  for (const VariedOption& one : varied) add_setting_list(one, what);
  what.add_options()("iterations", po::value<int>()->value_name("N"),
                     "default: the scene's with quick, 1 with sor");
  const po::options_description how =
      how_to_measure({"of the scene's variation and of the solver",
                      "how often each frame is timed with and without the effect, in turn", 15,
                      "noise floor: the scene as it is with this many other solver seeds", 4});
  po::options_description all;
  all.add(what).add(how).add(what_to_write("effects.h5")).add(common_options_description());
  return all;
}

/// The names given, each once and in the registry's order; all names if none is given.
std::vector<std::string> known_effects(const std::vector<std::string>& given) {
  for (const std::string& name : given) effects::require_effect(name);
  std::vector<std::string> names;
  for (const effects::Effect& effect : effects::effect_registry()) {
    if (given.empty() || std::find(given.begin(), given.end(), effect.name) != given.end())
      names.emplace_back(effect.name);
  }
  return names;
}

using stepping::StepperSettings;

constexpr const char* nothing_calls_for_it = "nothing calls for it";

/// The plan of all worlds of the scene with some effects chosen.
effects::RunPlan plan_of(const StudyScene& scene, std::uint64_t seed, const model::EffectChoices& effects) {
  const auto parsed = scenes::parse_scene(scene.source, scene.dt_s, effects);
  effects::RunPlan plan;
  for (int world = 0; world < scene.num_worlds; ++world) plan.add(*parsed->build(world, seed));
  return plan;
}

/// The effect's pass, or nothing.
std::optional<effects::RunPass> pass_of(const effects::RunPlan& plan, const std::string& effect) {
  for (const effects::RunPass& pass : plan.passes()) {
    if (pass.effect->name == effect) return pass;
  }
  return std::nullopt;
}

bool leaves_out(const StudyScene& scene, const std::string& effect) {
  const auto choice = scene.effects.find(effect);
  return choice != scene.effects.end() && !choice->second;
}

/// `baseline`: the plan of the unchanged scene.
EffectCase case_of(int index, const StudyScene& scene, std::uint64_t seed, const effects::RunPlan& baseline,
                   const std::string& effect) {
  EffectCase one;
  one.scene = index;
  one.effect = effect;
  const auto pass = pass_of(baseline, effect);
  one.kind = pass ? EffectCaseKind::left_out : EffectCaseKind::demanded;
  try {
    const effects::RunPlan variant = plan_of(scene, seed, one.choices());
    const auto demanded = pass ? pass : pass_of(variant, effect);
    const bool has_reason = demanded && !demanded->idle;
    // If only the variant gives the effect a reason, and the scene does not leave it out, it comes on request
    // alone.
    const bool on_request = !pass && has_reason && !leaves_out(scene, effect);
    one.called_for = has_reason && !on_request;
    one.reason = has_reason ? demanded->reason : nothing_calls_for_it;
    if (on_request) one.reason = "only on request; " + one.reason;
    if (pass && pass->idle) one.reason += "; the scene demands it";
    if (!pass && one.called_for) one.reason += "; the scene leaves it out";
  } catch (const core::InputError& error) {
    one.kind = EffectCaseKind::refused;
    one.called_for = pass && !pass->idle;
    one.reason = error.what();
  }
  return one;
}

std::vector<StepperSettings> steppers_of(const StudyScene& scene, const EffectsOptions& options) {
  std::vector<StepperSettings> all;
  cross_settings({}, options.settings, [&](const StepperSettings& chosen) {
    StepperSettings one = default_settings(chosen.kind);
    one.precision = chosen.precision;
    one.dt_s = scene.dt_s;
    one.iterations =
        options.iterations.value_or(default_iterations(chosen.kind, one.law.name, scene.iterations));
    one.seed = options.seed;
    all.push_back(one);
  });
  return all;
}

void add_floor(int index, StepperSettings stepper, int num_seeds, std::vector<EffectCase>& cases) {
  for (int i = 0; i < num_seeds; ++i) {
    ++stepper.seed;
    EffectCase one;
    one.scene = index;
    one.stepper = stepper;
    one.reason = "another solver seed";
    cases.push_back(one);
  }
}

}  // namespace

Manual effects_manual() {
  return {
      .name = "pbstudy effects",
      .about =
          "pbstudy effects measures what each effect costs. Each case is a scene (with its replicas), a "
          "stepper and an effect. From the scene's own state at the start of each measured frame the "
          "frame is done with and without the effect, in turn, so that both meet the same contacts. An "
          "effect that the scene calls for is left out: what that saves, and how far the result is then "
          "from the scene's own. One that nothing calls for is demanded: what that costs, and that no "
          "bit changes.",
      .usage = "mpirun -n RANKS pbstudy effects [--scene NAME...] [options]",
      .options = options_description(),
      .basic = {"scene", "effect", "stepper", "precision", "replicas", "frames", "repeats", "floor-seeds",
                "output", "max-time", "resume"},
      .notes = {std::string(one_case_a_rank) + spoils_times},
      .examples = {"mpirun -n 2 pbstudy effects --scene CrashWa", "pbreport effects.h5 --html effects.html"}};
}

EffectsOptions parse_effects_options(const std::vector<std::string>& args) {
  const po::variables_map values = parse_command_line(args, options_description());
  EffectsOptions options;
  static_cast<StudyOptions&>(options) = study_options(values, "pbstudy effects", args);
  options.effects = known_effects(list<std::string>(values, "effect", {}));
  options.settings = setting_lists(varied, values);
  options.iterations = given(values, "iterations", 1);
  return options;
}

model::EffectChoices EffectCase::choices() const {
  if (kind == EffectCaseKind::floor || kind == EffectCaseKind::refused) return {};
  return {{effect, kind == EffectCaseKind::demanded}};
}

double EffectCase::cost() const {
  const double nothing_to_do = kind == EffectCaseKind::refused ? 1e-6 : 1;
  return traits_of(stepper.kind).relative_cost * nothing_to_do * num_bodies;
}

std::vector<EffectCase> make_effect_cases(const std::vector<StudyScene>& scenes,
                                          const EffectsOptions& options) {
  std::vector<EffectCase> cases;
  for (std::size_t i = 0; i < scenes.size(); ++i) {
    const int index = static_cast<int>(i);
    const effects::RunPlan baseline = plan_of(scenes[i], options.seed, {});
    const std::size_t begin = cases.size();
    std::vector<EffectCase> of_scene;
    for (const std::string& effect : options.effects)
      of_scene.push_back(case_of(index, scenes[i], options.seed, baseline, effect));
    for (const StepperSettings& stepper : steppers_of(scenes[i], options)) {
      for (EffectCase& one : of_scene) {
        one.stepper = stepper;
        cases.push_back(one);
      }
      add_floor(index, stepper, options.floor_seeds, cases);
    }
    const auto first = scenes::parse_scene(scenes[i].source, scenes[i].dt_s)->build(0, 1);
    for (std::size_t k = begin; k < cases.size(); ++k)
      cases[k].num_bodies = scenes[i].num_worlds * first->num_bodies();
  }
  return cases;
}

}  // namespace pbmpi::app
