#include "app/common/engine_texts.h"
#include "app/pbstudy/effects/effects_runner.h"
#include "app/pbstudy/study/study_runner.h"
#include "app/pbstudy/study/table_columns.h"
#include "core/hash.h"

namespace pbmpi::app {
namespace {

using io::Parameter;

/// The run of the unchanged scene, shared by the cases of one scene and stepper.
struct Baseline {
  int scene = -1;
  stepping::StepperSettings stepper;
  Reference reference;

  bool serves(int for_scene, const stepping::StepperSettings& settings) const {
    return scene == for_scene && stepper.kind == settings.kind && stepper.precision == settings.precision;
  }
};

std::vector<EffectResult> run_cases(const EffectsOptions& options, const std::vector<EffectCase>& cases,
                                    StudyRunner& runner) {
  Baseline baseline;
  const auto run_one = [&](std::size_t i) {
    const EffectCase& one = cases[i];
    const StudyScene& scene = runner.scene(one.scene);
    stepping::StepperSettings stepper = one.stepper;
    stepper.seed = options.seed;
    if (!baseline.serves(one.scene, stepper)) baseline = {one.scene, stepper, make_reference(scene, stepper)};
    return run_effect_case(one, scene, baseline.reference, stepper, options.repeats);
  };
  return runner.run<EffectResult>(cases, &EffectCase::cost, run_one).results;
}

void add_spread(const std::string& name, const std::string& unit, Spread EffectResult::*spread,
                const std::vector<EffectResult>& results, std::vector<io::TableColumn>& columns) {
  const auto add = [&](const std::string& suffix, double Spread::*number) {
    columns.push_back(
        column(name + suffix, unit, results, [&](const EffectResult& r) { return r.*spread.*number; }));
  };
  add("", &Spread::median);
  add("_p10", &Spread::p10);
  add("_p90", &Spread::p90);
}

std::string hash_text(std::uint64_t hash) { return hash == 0 ? "" : core::to_hex(hash); }

/// 1 or 0; -1 where nothing is measured.
int same_bits(const EffectResult& result) {
  if (result.hash_baseline == 0) return -1;
  return result.hash_baseline == result.hash_variant ? 1 : 0;
}

/// Columns with one row per case (io/SCHEMA.md). `results` [num_cases] in the order of the cases.
std::vector<io::TableColumn> effect_columns(const std::vector<StudyScene>& scenes,
                                            const std::vector<EffectCase>& cases,
                                            const std::vector<EffectResult>& results) {
  using Case = const EffectCase&;
  using Result = const EffectResult&;
  std::vector<io::TableColumn> columns = {
      scene_column("scene", scenes, cases, &StudyScene::name),
      column("kind", "", cases,
             [](Case c) { return effect_case_kind_names[static_cast<std::size_t>(c.kind)]; }),
      column("effect", "", cases, &EffectCase::effect),
      column("called_for", "", cases, &EffectCase::called_for),
      column("reason", "", cases, &EffectCase::reason),
      scene_column("steps_per_frame", scenes, cases, &StudyScene::steps_per_frame),
      scene_column("worlds", scenes, cases, &StudyScene::num_worlds),
      scene_column("warmup", scenes, cases, &StudyScene::warmup),
      scene_column("frames", scenes, cases, &StudyScene::frames),
      column("same_bits", "", results, same_bits),
      column("hash_baseline", "", results, [](Result r) { return hash_text(r.hash_baseline); }),
      column("hash_variant", "", results, [](Result r) { return hash_text(r.hash_variant); }),
  };
  add_step_columns(cases, columns);
  add_spread("time_with", "s", &EffectResult::time_with_s, results, columns);
  add_spread("time_without", "s", &EffectResult::time_without_s, results, columns);
  add_spread("time_cost", "s", &EffectResult::cost_s, results, columns);
  add_spread("time_share", "", &EffectResult::share, results, columns);
  add_errors("defect", &EffectResult::defect, results, columns);
  add_errors("drift", &EffectResult::drift, results, columns);
  return columns;
}

StudyContent content(const std::vector<StudyScene>& scenes, const std::vector<EffectCase>& cases,
                     const std::vector<EffectResult>& results) {
  stepping::StepperSettings sor;
  sor.kind = stepping::StepperKind::sor;
  StudyContent content;
  content.parameters = {Parameter::of("sor_simd", simd_text(sor))};
  content.cases = effect_columns(scenes, cases, results);
  return content;
}

}  // namespace

core::ExitCode run_effects(const mpi::Communicator& comm, const std::vector<std::string>& args) {
  const EffectsOptions options = parse_effects_options(args);
  StudyRunner runner(comm, "effects", options);
  const std::vector<EffectCase> cases = make_effect_cases(runner.scenes(), options);
  runner.open_output();
  const std::vector<EffectResult> results = run_cases(options, cases, runner);
  runner.write([&] { return content(runner.scenes(), cases, results); });
  return core::ExitCode::done;
}

}  // namespace pbmpi::app
