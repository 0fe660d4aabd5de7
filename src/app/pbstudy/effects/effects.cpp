#include "app/pbstudy/effects/effects.h"

#include <algorithm>
#include <iostream>
#include <optional>

#include "app/common/load_scene.h"
#include "app/common/stepper_factory.h"
#include "app/common/version.h"
#include "app/pbstudy/effects/counted_study.h"
#include "app/pbstudy/effects/effects_table.h"
#include "app/pbstudy/study/study_run.h"

namespace pbmpi::app {
namespace {

using io::Parameter;

/// The run of the scene as it is, that the cases of one scene and stepper share.
struct Baseline {
  int scene = -1;
  stepping::StepperSettings stepper;
  Reference reference;

  bool serves(int for_scene, const stepping::StepperSettings& settings) const {
    return scene == for_scene && stepper.kind == settings.kind && stepper.precision == settings.precision;
  }
};

std::vector<EffectResult> run_cases(const mpi::Communicator& comm, const EffectsOptions& options,
                                    const std::vector<StudyScene>& scenes,
                                    const std::vector<EffectCase>& cases, core::InstructionCounter& counter) {
  const std::vector<int> owner = deal_out(cases, scenes, comm.size());
  CaseProgress progress(options.common, comm.is_root(),
                        static_cast<std::size_t>(std::count(owner.begin(), owner.end(), comm.rank())));
  Baseline baseline;
  return run_dealt_out<EffectResult>(comm, owner, [&](std::size_t i) {
    const EffectCase& one = cases[i];
    const StudyScene& scene = scenes[static_cast<std::size_t>(one.scene)];
    stepping::StepperSettings stepper = one.stepper;
    stepper.seed = options.seed;
    if (!baseline.serves(one.scene, stepper)) baseline = {one.scene, stepper, make_reference(scene, stepper)};
    const EffectResult result =
        run_effect_case(one, scene, baseline.reference, stepper, options.repeats, counter);
    progress.next(scene.source.name);
    return result;
  });
}

io::TableFile study_file(const EffectsOptions& options, const std::vector<StudyScene>& scenes,
                         const std::vector<EffectCase>& cases, const std::vector<EffectResult>& results,
                         const std::string& counted_by, const Provenance& provenance) {
  stepping::StepperSettings sor;
  sor.kind = stepping::StepperKind::sor;
  io::TableFile file;
  file.attributes = study_attributes("effects", provenance);
  file.parameters = {Parameter::of("seed", static_cast<std::int64_t>(options.seed)),
                     Parameter::of("repeats", std::int64_t{options.repeats}),
                     Parameter::of("floor_seeds", std::int64_t{options.floor_seeds}),
                     Parameter::of("instructions_by", counted_by),
                     Parameter::of("sor_simd", simd_text(sor)),
                     Parameter::of("ranks", static_cast<std::int64_t>(provenance.hosts.size())),
                     Parameter::of("build", build_description)};
  for (const StudyScene& scene : scenes) {
    file.parameters.push_back(Parameter::of("scene_text_" + scene.source.name, scene.source.text));
  }
  file.tables["cases"] = effect_columns(scenes, cases, results, counted_by != "none");
  return file;
}

void print_end(const EffectsOptions& options, std::size_t num_cases, std::size_t num_scenes,
               const std::string& counted_by) {
  std::cout << num_cases << " cases of " << num_scenes << (num_scenes == 1 ? " scene" : " scenes") << " in "
            << options.output << "\n";
  if (counted_by == "none") {
    std::cout << "instructions: not counted, this machine gives no counter; jobs/effects.sh --instructions "
                 "counts them by callgrind\n";
  } else {
    std::cout << "instructions: counted by " << counted_by << "\n";
  }
  std::cout << "next: pbreport " << options.output << "\n" << std::flush;
}

}  // namespace

core::ExitCode run_effects(const mpi::Communicator& comm, const std::vector<std::string>& args) {
  const EffectsOptions options = parse_effects_options(args);
  if (options.help) {
    if (comm.is_root()) std::cout << effects_help_text() << std::flush;
    return core::ExitCode::done;
  }
  std::vector<StudyScene> scenes;
  for (const std::string& name : options.scenes)
    scenes.push_back(study_scene(share_scene(comm, name), options.overrides));
  const std::vector<EffectCase> cases = make_effect_cases(scenes, options);
  std::unique_ptr<io::TableWriter> writer;
  std::optional<CountedStudy> counted;
  mpi::agree_on_errors(comm, [&] {
    if (!comm.is_root()) return;
    if (options.instructions_from) counted.emplace(*options.instructions_from, scenes, cases);
    writer = std::make_unique<io::TableWriter>(options.output);
  });
  const Provenance provenance = collect_provenance(comm, options.command_line);
  core::InstructionCounter counter;
  std::vector<EffectResult> results = run_cases(comm, options, scenes, cases, counter);
  mpi::agree_on_errors(comm, [&] {
    if (!comm.is_root()) return;
    if (counted) counted->give_counts(results);
    const std::string counted_by = counted ? counted->source() : std::string(core::name_of(counter.source()));
    writer->write("pbmpi-study", study_file(options, scenes, cases, results, counted_by, provenance));
    if (!options.common.quiet) print_end(options, cases.size(), scenes.size(), counted_by);
  });
  return core::ExitCode::done;
}

}  // namespace pbmpi::app
