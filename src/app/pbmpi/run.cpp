#include "app/pbmpi/run.h"

#include <filesystem>
#include <iostream>
#include <memory>

#include "app/common/load_scene.h"
#include "app/common/version.h"
#include "app/pbmpi/describe.h"
#include "app/pbmpi/estimate_monitor.h"
#include "app/pbmpi/gather_plan.h"
#include "app/pbmpi/live_summary.h"
#include "app/pbmpi/options.h"
#include "app/pbmpi/progress.h"
#include "app/pbmpi/provenance.h"
#include "app/pbmpi/signals.h"
#include "app/pbmpi/stepper_factory.h"
#include "core/hash.h"
#include "estimate/same_solve.h"
#include "estimate/short_run.h"
#include "io/run_file.h"
#include "io/xdmf.h"
#include "model/effect_choices.h"
#include "model/names.h"
#include "mpi/agreement.h"
#include "mpi/space_driver.h"
#include "mpi/world_driver.h"

namespace pbmpi::app {
namespace {

using core::ExitCode;

std::string scene_list() {
  std::string text;
  for (const scenes::SceneInfo& scene : scenes::list_scenes()) {
    text += scene.name + std::string(scene.name.size() < 12 ? 12 - scene.name.size() : 1, ' ') + scene.title +
            "\n";
  }
  return text;
}

mpi::WorldRunSettings driver_settings(const RunSpec& spec) {
  mpi::WorldRunSettings settings;
  settings.num_worlds = spec.num_worlds;
  settings.warmup = spec.warmup;
  settings.frames = spec.frames;
  settings.steps_per_frame = spec.steps_per_frame;
  settings.dt_s = spec.stepper.dt_s;
  settings.profile = spec.record_islands;
  return settings;
}

RunSummary settings_summary(const scenes::Scene& scene, const RunSpec& spec, const Provenance& provenance,
                            std::int64_t num_bodies, double budget_s) {
  RunSummary summary;
  summary.version = program_version;
  summary.scene = scene.name();
  summary.stepper = name_of(spec.stepper.kind);
  summary.output = spec.output.value_or("");
  summary.hosts = distinct(provenance.hosts);
  summary.worlds = spec.num_worlds;
  summary.ranks = static_cast<int>(provenance.hosts.size());
  summary.decomposition = spec.decomposition == Decomposition::spaces ? "spaces" : "worlds";
  summary.iterations = spec.stepper.iterations;
  summary.substeps = spec.stepper.substeps;
  summary.precision = model::name_of(spec.stepper.precision);
  summary.simd = simd_text(spec.stepper);
  summary.steps_per_frame = spec.steps_per_frame;
  summary.bodies = num_bodies;
  summary.seed = spec.scene_seed;
  summary.dt_s = spec.stepper.dt_s;
  summary.budget_s = budget_s;
  summary.warmup_frames = spec.warmup;
  summary.effects_chosen = model::to_text(spec.effects);
  return summary;
}

EstimateSummary estimate_summary(const RunSpec& spec, const mpi::WorldRunResult& result,
                                 const EstimateMonitor& monitor, double budget_s) {
  EstimateSummary summary;
  const model::StepperSettings& settings = *spec.estimate;
  summary.stepper = name_of(settings.kind);
  summary.source = estimate_source_names[static_cast<std::size_t>(spec.estimate_source)];
  summary.iterations = settings.iterations;
  summary.precision = name_of(settings.precision);
  std::vector<double> delivered_s, precise_s;
  for (const mpi::FrameTimes& times : result.times) {
    if (!times.measured) continue;
    delivered_s.push_back(times.delivered_s);
    precise_s.push_back(times.wall_s);
  }
  compute_delivery(delivered_s, precise_s, budget_s, summary);
  summary.position_defect = monitor.position_defect();
  summary.orientation_defect = monitor.orientation_defect();
  return summary;
}

std::unique_ptr<io::RunFile> create_output(const mpi::Communicator& comm, const mpi::FrameDriver& driver,
                                           const scenes::Scene& scene, const RunSpec& spec,
                                           const Provenance& provenance) {
  if (!spec.output) return nullptr;
  io::RunSetup setup;
  setup.path = *spec.output;
  setup.attributes = run_attributes(scene, spec, provenance);
  setup.parameters = run_parameters(scene, spec, provenance);
  setup.table = driver.table();
  setup.worlds = driver.local_worlds();
  setup.hosts = provenance.hosts;
  setup.num_frames = spec.total_frames();
  setup.record_every = spec.record_every;
  setup.optional = optional_columns(scene, spec);
  return std::make_unique<io::RunFile>(io::FileGroup{comm.fortran_handle(), comm.rank(), comm.size()},
                                       std::move(setup));
}

/// The sidecar stands beside the run file: "x.h5" gets "x.xdmf".
void write_sidecar(const mpi::Communicator& comm, const std::string& run_path) {
  mpi::agree_on_errors(comm, [&] {
    if (comm.is_root()) {
      io::write_xdmf(run_path, std::filesystem::path(run_path).replace_extension(".xdmf").string());
    }
  });
}

void print(const mpi::Communicator& comm, const Options& options, const RunSummary& summary) {
  if (!comm.is_root()) return;
  if (options.report == ReportFormat::json) {
    std::cout << to_json(summary) << std::flush;
  } else if (!options.common.quiet) {
    std::cout << to_text(summary) << std::flush;
  }
}

/// A run that fails still writes the frames that its file holds.
mpi::WorldRunResult run_to_end(mpi::FrameDriver& driver, io::RunFile* file) {
  try {
    return driver.run();
  } catch (const core::RunError&) {
    try {
      if (file != nullptr) file->close(false, core::to_hex(0));
    } catch (const core::RunError&) {
      // The error that ended the run is the one to report.
    }
    throw;
  }
}

/// A driver and what it borrows.
struct Simulation {
  std::unique_ptr<model::WorldStepper> worlds;
  std::unique_ptr<model::SpaceStepper> spaces;
  std::unique_ptr<model::Estimator> estimator;  ///< with FEEC
  std::unique_ptr<mpi::FrameDriver> driver;
};

Simulation make_simulation(const mpi::Communicator& comm, const scenes::Scene& scene, const RunSpec& spec) {
  Simulation simulation;
  const auto build = [&](int world) { return scene.build(world, spec.scene_seed); };
  if (spec.decomposition == Decomposition::spaces) {
    simulation.spaces =
        mpi::agree_on_errors(comm, [&] { return make_space_stepper(spec.stepper, build(0)); });
    simulation.driver = std::make_unique<mpi::SpaceDriver>(comm, *simulation.spaces, driver_settings(spec));
  } else {
    if (spec.estimate && spec.estimate_source == EstimateSource::same_solve) {
      auto stepper = make_anytime_stepper(spec.stepper);
      simulation.estimator = std::make_unique<estimate::SameSolve>(*stepper, spec.estimate->iterations);
      simulation.worlds = std::move(stepper);
    } else {
      simulation.worlds = make_stepper(spec.stepper);
      if (spec.estimate)
        simulation.estimator =
            std::make_unique<estimate::ShortRun>(make_stepper(*spec.estimate, "estimate: "));
    }
    auto driver = std::make_unique<mpi::WorldDriver>(comm, *simulation.worlds, build, driver_settings(spec));
    if (simulation.estimator) driver->set_estimator(*simulation.estimator);
    simulation.driver = std::move(driver);
  }
  return simulation;
}

ExitCode simulate(const mpi::Communicator& comm, const Options& options, const scenes::Scene& scene,
                  const RunSpec& spec) {
  const StopOnSignal stop;
  const Simulation simulation = make_simulation(comm, scene, spec);
  mpi::FrameDriver& driver = *simulation.driver;
  driver.set_stop_flag(stop.flag());

  const Provenance provenance = collect_provenance(comm, options.command_line);
  const auto file = create_output(comm, driver, scene, spec, provenance);
  EstimateMonitor monitor(spec.warmup);
  if (spec.estimate) driver.add_consumer(monitor);
  LiveSummary live;
  driver.add_observer(live);
  if (file) driver.add_observer(*file);
  std::unique_ptr<ProgressBar> progress;
  if (comm.is_root() && wants_progress(options.common.progress, options.common.quiet)) {
    progress = std::make_unique<ProgressBar>(std::cerr, spec.total_frames());
    driver.add_observer(*progress);
  }

  const mpi::WorldRunResult result = run_to_end(driver, file.get());

  progress.reset();
  RunSummary summary =
      settings_summary(scene, spec, provenance, driver.table().num_bodies(), driver_settings(spec).budget_s);
  summary.effects = effect_summaries(gather_plan(comm, driver.local_worlds()));
  summary.idle_ranks = driver.idle_ranks();
  live.finish(comm, result, summary);
  if (spec.estimate) summary.estimate = estimate_summary(spec, result, monitor, summary.budget_s);
  if (file) {
    file->close(summary.complete, summary.state_hash);
    write_sidecar(comm, *spec.output);
  }
  print(comm, options, summary);
  if (!result.failure.empty()) throw core::RunError(result.failure);
  return result.stopped ? ExitCode::stopped : ExitCode::done;
}

}  // namespace

ExitCode run_pbmpi(const mpi::Communicator& comm, const std::vector<std::string>& args) {
  const Options options = parse_options(args);
  const auto say = [&](const std::string& text) {
    if (comm.is_root()) std::cout << text << std::flush;
    return ExitCode::done;
  };
  switch (options.action) {
    case Action::help:
      return say(help_text());
    case Action::version:
      return say(version_line("pbmpi") + "\n");
    case Action::list_scenes:
      return say(scene_list());
    case Action::describe:
    case Action::run:
      break;
  }
  const auto scene = load_scene(comm, options.scene, options.dt_s, options.spaces, options.effects);
  RunSpec spec = resolve(options, *scene);
  const auto num_spaces = static_cast<int>(scene->build(0, spec.scene_seed)->spaces.size());
  spec.decomposition = decompose(spec, num_spaces, comm.size());
  if (options.action == Action::run) return simulate(comm, options, *scene, spec);
  mpi::agree_on_errors(comm, [&] {
    if (comm.is_root()) say(describe(*scene, spec, comm.size()));
  });
  return ExitCode::done;
}

}  // namespace pbmpi::app
