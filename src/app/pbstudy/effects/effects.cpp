#include "app/common/engine_texts.h"
#include "app/pbstudy/effects/effects_runner.h"
#include "app/pbstudy/study/studies.h"
#include "app/pbstudy/study/study_runner.h"

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
                                    core::InstructionCounter& counter, StudyRunner& runner) {
  Baseline baseline;
  const auto run_one = [&](std::size_t i) {
    const EffectCase& one = cases[i];
    const StudyScene& scene = runner.scene(one.scene);
    stepping::StepperSettings stepper = one.stepper;
    stepper.seed = options.seed;
    if (!baseline.serves(one.scene, stepper)) baseline = {one.scene, stepper, make_reference(scene, stepper)};
    return run_effect_case(one, scene, baseline.reference, stepper, options.repeats, counter);
  };
  return runner.run<EffectResult>(cases, &EffectCase::cost, run_one).results;
}

StudyContent content(const std::vector<StudyScene>& scenes, const std::vector<EffectCase>& cases,
                     const std::vector<EffectResult>& results, const std::string& counted_by) {
  stepping::StepperSettings sor;
  sor.kind = stepping::StepperKind::sor;
  const bool counted = counted_by != "none";
  StudyContent content;
  content.parameters = {Parameter::of("instructions_by", counted_by),
                        Parameter::of("sor_simd", simd_text(sor))};
  content.cases = effect_columns(scenes, cases, results, counted);
  content.note =
      counted ? "instructions: counted by " + counted_by + "\n"
              : "instructions: not counted, this machine gives no counter; jobs/effects.sh --instructions "
                "counts them by callgrind\n";
  return content;
}

}  // namespace

core::ExitCode run_effects(const mpi::Communicator& comm, const std::vector<std::string>& args) {
  const EffectsOptions options = parse_effects_options(args);
  StudyRunner runner(comm, "effects", options);
  const std::vector<EffectCase> cases = make_effect_cases(runner.scenes(), options);
  runner.open_output();
  core::InstructionCounter counter;
  const std::vector<EffectResult> results = run_cases(options, cases, counter, runner);
  runner.write(
      [&] { return content(runner.scenes(), cases, results, std::string(core::name_of(counter.source()))); });
  return core::ExitCode::done;
}

}  // namespace pbmpi::app
