#include "app/pbstudy/accuracy/accuracy.h"

#include <algorithm>
#include <iostream>
#include <optional>

#include "app/common/load_scene.h"
#include "app/common/version.h"
#include "app/pbstudy/accuracy/accuracy_table.h"
#include "app/pbstudy/study/study_run.h"

namespace pbmpi::app {
namespace {

using io::Parameter;

/// Runs this rank's cases; the reference of a scene is made by each rank that has cases of it.
std::vector<CaseResult> run_cases(const mpi::Communicator& comm, const AccuracyOptions& options,
                                  const std::vector<StudyScene>& scenes,
                                  const std::vector<AccuracyCase>& cases) {
  const std::vector<int> owner = deal_out(cases, scenes, comm.size());
  CaseProgress progress(options.common, comm.is_root(),
                        static_cast<std::size_t>(std::count(owner.begin(), owner.end(), comm.rank())));
  std::optional<Reference> reference;
  int reference_scene = -1;
  return run_dealt_out<CaseResult>(comm, owner, [&](std::size_t i) {
    const StudyScene& scene = scenes[static_cast<std::size_t>(cases[i].scene)];
    if (cases[i].scene != reference_scene) {
      reference = make_reference(scene, reference_settings(scene, options));
      reference_scene = cases[i].scene;
    }
    const CaseResult result = run_case(cases[i], scene, *reference, options.repeats);
    progress.next(scene.source.name);
    return result;
  });
}

io::TableFile study_file(const AccuracyOptions& options, const std::vector<StudyScene>& scenes,
                         const std::vector<AccuracyCase>& cases, const std::vector<CaseResult>& results,
                         const Provenance& provenance) {
  io::TableFile file;
  file.attributes = study_attributes("accuracy", provenance);
  file.parameters = {Parameter::of("reference_stepper", "sor"),
                     Parameter::of("reference_precision", "double"),
                     Parameter::of("reference_iterations", std::int64_t{options.reference_iterations}),
                     Parameter::of("reference_substeps", std::int64_t{options.reference_substeps}),
                     Parameter::of("seed", static_cast<std::int64_t>(options.seed)),
                     Parameter::of("repeats", std::int64_t{options.repeats}),
                     Parameter::of("floor_seeds", std::int64_t{options.floor_seeds}),
                     Parameter::of("ranks", static_cast<std::int64_t>(provenance.hosts.size())),
                     Parameter::of("build", build_description)};
  for (const StudyScene& scene : scenes) {
    file.parameters.push_back(Parameter::of("scene_text_" + scene.source.name, scene.source.text));
  }
  file.tables["cases"] = case_columns(scenes, cases, results);
  return file;
}

}  // namespace

core::ExitCode run_accuracy(const mpi::Communicator& comm, const std::vector<std::string>& args) {
  const AccuracyOptions options = parse_accuracy_options(args);
  if (options.help) {
    if (comm.is_root()) std::cout << accuracy_help_text() << std::flush;
    return core::ExitCode::done;
  }
  std::vector<StudyScene> scenes;
  for (const std::string& name : options.scenes)
    scenes.push_back(study_scene(share_scene(comm, name), options));
  const std::vector<AccuracyCase> cases = make_cases(scenes, options);
  std::unique_ptr<io::TableWriter> writer;
  mpi::agree_on_errors(comm, [&] {
    if (comm.is_root()) writer = std::make_unique<io::TableWriter>(options.output);
  });
  const Provenance provenance = collect_provenance(comm, options.command_line);
  const std::vector<CaseResult> results = run_cases(comm, options, scenes, cases);
  mpi::agree_on_errors(comm, [&] {
    if (comm.is_root()) writer->write("pbmpi-study", study_file(options, scenes, cases, results, provenance));
  });
  if (comm.is_root() && !options.common.quiet) {
    std::cout << cases.size() << " cases of " << scenes.size() << (scenes.size() == 1 ? " scene" : " scenes")
              << " in " << options.output << "\nnext: pbreport " << options.output << " --budget 3.33ms\n"
              << std::flush;
  }
  return core::ExitCode::done;
}

}  // namespace pbmpi::app
