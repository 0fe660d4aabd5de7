#include "app/pbstudy/accuracy.h"

#include <unistd.h>

#include <algorithm>
#include <iostream>
#include <optional>

#include "app/common/load_scene.h"
#include "app/common/version.h"
#include "app/pbmpi/provenance.h"
#include "app/pbstudy/accuracy_table.h"
#include "mpi/agreement.h"

namespace pbmpi::app {
namespace {

using io::Parameter;

/// One line of stderr that is written over: root's own cases, which stand for the others'.
class CaseProgress {
 public:
  CaseProgress(bool wanted, std::size_t total) : wanted_(wanted), total_(total) {}
  ~CaseProgress() {
    if (drawn_) std::cerr << std::endl;
  }
  CaseProgress(const CaseProgress&) = delete;
  CaseProgress& operator=(const CaseProgress&) = delete;

  void next(const std::string& scene) {
    ++done_;
    if (!wanted_) return;
    std::cerr << "\rpbstudy: case " << done_ << " of " << total_ << " on this rank (" << scene << ")   "
              << std::flush;
    drawn_ = true;
  }

 private:
  bool wanted_;
  bool drawn_ = false;
  std::size_t done_ = 0, total_;
};

bool wants_progress(const AccuracyOptions& options, bool is_root) {
  if (!is_root || options.common.quiet || options.common.progress == ProgressMode::never) return false;
  return options.common.progress == ProgressMode::always || isatty(STDERR_FILENO) != 0;
}

/// This rank's cases, one at a time; the reference of a scene is made by each rank that has cases of it.
std::vector<CaseResult> run_own(const mpi::Communicator& comm, const AccuracyOptions& options,
                                const std::vector<StudyScene>& scenes,
                                const std::vector<AccuracyCase>& cases) {
  const std::vector<int> owner = deal_out(cases, scenes, comm.size());
  CaseProgress progress(wants_progress(options, comm.is_root()),
                        static_cast<std::size_t>(std::count(owner.begin(), owner.end(), comm.rank())));
  std::vector<CaseResult> results;
  std::optional<Reference> reference;
  int reference_scene = -1;
  for (std::size_t i = 0; i < cases.size(); ++i) {
    if (owner[i] != comm.rank()) continue;
    const StudyScene& scene = scenes[static_cast<std::size_t>(cases[i].scene)];
    if (cases[i].scene != reference_scene) {
      reference = make_reference(scene, reference_settings(scene, options));
      reference_scene = cases[i].scene;
    }
    results.push_back(run_case(cases[i], scene, *reference, options.repeats));
    results.back().index = static_cast<int>(i);
    progress.next(scene.source.name);
  }
  return results;
}

/// All results in the order of the cases, on every rank.
std::vector<CaseResult> gather(const mpi::Communicator& comm, const std::vector<CaseResult>& own,
                               std::size_t num_cases) {
  const std::vector<CaseResult> all = comm.allgatherv(std::span<const CaseResult>(own));
  core::require_invariant(all.size() == num_cases, "every case has one result");
  std::vector<CaseResult> ordered(num_cases);
  for (const CaseResult& result : all) ordered[static_cast<std::size_t>(result.index)] = result;
  return ordered;
}

io::TableFile study_file(const AccuracyOptions& options, const std::vector<StudyScene>& scenes,
                         const std::vector<AccuracyCase>& cases, const std::vector<CaseResult>& results,
                         const Provenance& provenance) {
  io::TableFile file;
  file.attributes = {{"study", "accuracy"},
                     {"pbmpi_version", program_version},
                     {"git_revision", git_revision},
                     {"created", provenance.created},
                     {"command_line", options.command_line}};
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
  const auto own = mpi::agree_on_errors(comm, [&] { return run_own(comm, options, scenes, cases); });
  const std::vector<CaseResult> results = gather(comm, own, cases.size());
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
