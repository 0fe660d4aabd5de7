#include "app/pbmpi/run.h"

#include <unistd.h>

#include <algorithm>
#include <cstdlib>
#include <iostream>
#include <memory>

#include "app/common/engine_texts.h"
#include "app/common/provenance.h"
#include "app/common/version.h"
#include "app/pbmpi/checkpoint_keeper.h"
#include "app/pbmpi/describe.h"
#include "app/pbmpi/options/options.h"
#include "app/pbmpi/progress.h"
#include "app/pbmpi/run_parameters.h"
#include "app/pbmpi/signals.h"
#include "app/pbmpi/simulation.h"
#include "app/pbmpi/work.h"
#include "app/pbmpi/world_results.h"
#include "app/summary/live_summary.h"
#include "core/error.h"
#include "core/hash.h"
#include "core/system/awaited.h"
#include "core/system/thread_pool.h"
#include "effects/effect_choices.h"
#include "io/run/run_file.h"
#include "io/run/xdmf.h"
#include "model/names.h"
#include "mpi/comm/agreement.h"
#include "stepping/names.h"
#include "stepping/option_values.h"

namespace pbmpi::app {
namespace {

using core::ExitCode;

/// One line per scene: name and title.
std::string titled_list(scenes::SceneGroup group, const std::string& indent) {
  const std::vector<scenes::SceneInfo> list = scenes::list_scenes(group);
  std::size_t width = 12;
  for (const scenes::SceneInfo& scene : list) width = std::max(width, scene.name.size() + 1);
  std::string text;
  for (const scenes::SceneInfo& scene : list)
    text += indent + scene.name + std::string(width - scene.name.size(), ' ') + scene.title + "\n";
  return text;
}

std::string scene_list() {
  return titled_list(scenes::SceneGroup::paper, "") + "Scenes of single effects (docs/effects.md):\n" +
         titled_list(scenes::SceneGroup::effects, "  ") +
         "Motions known in closed form (docs/accuracy.md):\n" + titled_list(scenes::SceneGroup::exact, "  ") +
         "Hard cases (docs/stability.md):\n" + titled_list(scenes::SceneGroup::hard, "  ");
}

RunSummary settings_summary(const scenes::Scene& scene, const RunSpec& spec, const Provenance& provenance,
                            std::int64_t num_bodies) {
  RunSummary summary;
  summary.version = program_version;
  summary.scene = scene.name();
  summary.stepper = name_of(spec.stepper.kind);
  summary.output = spec.output.value_or("");
  summary.hosts = distinct(provenance.hosts);
  summary.worlds = spec.num_worlds;
  summary.ranks = static_cast<int>(provenance.hosts.size());
  summary.threads = spec.stepper.threads;
  summary.decomposition = spec.decomposition == Decomposition::spaces ? "spaces" : "worlds";
  summary.groups = spec.groups;
  summary.iterations = spec.stepper.iterations;
  summary.substeps = spec.stepper.substeps;
  summary.precision = name_of(spec.stepper.precision);
  summary.simd = simd_text(spec.stepper);
  summary.steps_per_frame = spec.steps_per_frame;
  summary.bodies = num_bodies;
  summary.seed = spec.seed;
  summary.dt_s = spec.stepper.dt_s;
  summary.budget_s = spec.budget_s;
  summary.first_frame = spec.checkpoint.first_frame;
  summary.warmup_frames = std::max<std::int64_t>(0, spec.warmup - summary.first_frame);
  summary.effects_chosen = effects::to_text(spec.effects);
  return summary;
}

EstimateSummary estimate_summary(const RunSpec& spec, const mpi::WorldRunResult& result,
                                 const EstimateMonitor& monitor) {
  EstimateSummary summary;
  const stepping::StepperSettings& settings = *spec.estimate;
  summary.stepper = name_of(settings.kind);
  summary.iterations = settings.iterations;
  summary.precision = name_of(settings.precision);
  std::vector<double> delivered_s, precise_s;
  for (const mpi::FrameTimes& times : result.times) {
    if (!times.measured) continue;
    delivered_s.push_back(times.delivered_s);
    precise_s.push_back(times.wall_s);
  }
  compute_delivery(delivered_s, precise_s, spec.budget_s, summary);
  summary.position_defect = monitor.position_defect();
  summary.orientation_defect = monitor.orientation_defect();
  return summary;
}

std::unique_ptr<io::RunFile> create_output(const mpi::Communicator& comm, const mpi::FrameDriver& driver,
                                           const Work& work, const effects::RunPlan& plan,
                                           const Provenance& provenance) {
  const RunSpec& spec = work.spec;
  if (!spec.output) return nullptr;
  io::RunSetup setup;
  setup.path = *spec.output;
  setup.attributes = run_attributes(work, provenance, plan);
  setup.parameters = run_parameters(work, provenance);
  setup.world_parameters = world_parameters(work);
  setup.first_world = spec.first_world();
  setup.table = driver.table();
  setup.worlds = driver.local_worlds();
  setup.hosts = provenance.hosts;
  setup.first_frame = spec.checkpoint.first_frame;
  setup.num_frames = spec.frames_to_do();
  setup.record_every = spec.record_every;
  setup.optional = optional_columns(work, plan);
  setup.substep_s = stepping::substep_s(spec.stepper);
  return std::make_unique<io::RunFile>(io::FileGroup{comm.fortran_handle(), comm.rank(), comm.size()},
                                       std::move(setup));
}

/// Only warns about a sidecar that cannot be written.
void write_sidecar(const mpi::Communicator& comm, const RunSpec& spec) {
  if (!comm.is_root() || !spec.sidecar) return;
  try {
    io::write_sidecar(*spec.output, *spec.sidecar);
  } catch (const std::runtime_error& error) {
    std::cerr << "pbmpi: warning: no sidecar for ParaView: " << error.what() << std::endl;
  }
}

/// Is stdout read by somebody? Under mpirun it looks like a terminal even where it is a file, but stderr does
/// not.
bool is_on_terminal() {
  return isatty(STDOUT_FILENO) != 0 && isatty(STDERR_FILENO) != 0 && std::getenv("NO_COLOR") == nullptr;
}

void print(const mpi::Communicator& comm, const Options& options, const RunSummary& summary) {
  if (!comm.is_root()) return;
  if (options.run.report == ReportFormat::json) {
    std::cout << to_json(summary) << std::flush;
  } else if (!options.common.quiet) {
    const bool is_full = options.run.report == ReportFormat::full;
    std::cout << (is_full ? to_text(summary) : to_short_text(summary, is_on_terminal())) << std::flush;
  }
}

/// Launchers bind a rank to a core unless told otherwise; threads then take turns on it. Collective.
void warn_of_bound_threads(const mpi::Communicator& comm, int num_threads) {
  const std::vector<int> processors = comm.allgather(core::num_usable_processors());
  const auto fewest = std::ranges::min_element(processors);
  if (!comm.is_root() || *fewest >= num_threads) return;
  std::cerr << "pbmpi: warning: rank " << fewest - processors.begin() << " may use " << *fewest
            << (*fewest == 1 ? " processor" : " processors") << ", on which its " << num_threads
            << " threads take turns; start with `mpirun --bind-to none`, or give fewer --threads"
            << std::endl;
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

/// A path for checkpoints that was asked for is tried before the run, not after hours of it. The default path
/// is reserved where possible.
void reserve(const mpi::Communicator& comm, const RunSpec& spec, std::int64_t num_bodies,
             CheckpointKeeper& keeper) {
  constexpr std::int64_t about_bytes_each = 1024, about_bytes = std::int64_t{1} << 17;
  mpi::agree_on_errors(comm, [&] {
    if (comm.is_root())
      keeper.reserve(about_bytes + about_bytes_each * num_bodies,
                     spec.checkpoint_file || spec.checkpoint_every_s);
  });
}

ExitCode simulate(const mpi::Communicator& comm, const Options& options, Work work,
                  const SignalRequests& signals, double start_s) {
  const scenes::Scene& scene = *work.scene;
  const RunSpec& spec = work.spec;
  const bool speaks = comm.is_root() && !options.common.quiet;
  warn_of_bound_threads(comm, spec.stepper.threads);
  std::optional<core::Awaited> awaited("all ranks to build their worlds");
  const Simulation simulation = make_simulation(comm, work);
  work.states = {};
  mpi::FrameDriver& driver = *simulation.driver;
  driver.set_stop_flag(signals.stop());
  CheckpointKeeper keeper(spec.checkpoint.path, checkpoint_without_states(work, options.run.decomposition),
                          std::cerr);
  reserve(comm, spec, driver.table().num_bodies(), keeper);
  mpi::CheckpointPlan plan;
  plan.requests = &signals.saves();
  plan.every_s = spec.checkpoint_every_s.value_or(plan.every_s);
  plan.at_end = spec.checkpoint_file.has_value();
  driver.save_to(keeper, plan);
  if (spec.max_time_s) driver.set_time_limit(start_s + *spec.max_time_s);

  const Provenance provenance = collect_provenance(comm, options.command_line);
  if (speaks) std::cerr << shared_processors_warning("pbmpi", provenance, spec.stepper.threads) << std::flush;
  signals.enter(SignalRequests::Phase::begin_or_end, speaks);
  awaited.emplace("all ranks to create " + spec.output.value_or("no file"));
  const effects::RunPlan step_plan = gather_plan(comm, driver.local_worlds());
  const auto file = create_output(comm, driver, work, step_plan, provenance);
  awaited.reset();
  EstimateMonitor monitor(spec.warmup);
  if (spec.estimate) driver.add_consumer(monitor);
  LiveSummary live;
  driver.add_observer(live);
  if (file) driver.add_observer(*file);
  std::unique_ptr<RunProgress> progress;
  const ProgressForm form = progress_form(options.common);
  if (comm.is_root() && form != ProgressForm::none) {
    progress =
        std::make_unique<RunProgress>(std::cerr, form, spec.total_frames(), spec.checkpoint.first_frame);
    driver.add_observer(*progress);
  }

  WorldResults results(spec.num_worlds, [&driver] { return driver.costs(); });
  driver.add_observer(results);

  FrameWatch watch;
  driver.add_observer(watch);

  signals.enter(SignalRequests::Phase::frames, speaks);
  const mpi::WorldRunResult result = run_to_end(driver, file.get());
  signals.enter(SignalRequests::Phase::begin_or_end, speaks);
  awaited.emplace("all ranks to close " + spec.output.value_or("no file"));

  progress.reset();
  RunSummary summary = settings_summary(scene, spec, provenance, driver.table().num_bodies());
  summary.effects = effect_summaries(step_plan);
  summary.idle_ranks = driver.idle_ranks();
  live.finish(comm, result, summary);
  if (spec.estimate) summary.estimate = estimate_summary(spec, result, monitor);
  const std::vector<io::WorldResult> world_results = results.join(comm, driver.local_worlds());
  summary.worlds_survived = std::ranges::count(world_results, 1, &io::WorldResult::survived);
  if (file) {
    file->close(summary.complete, summary.state_hash, world_results);
    write_sidecar(comm, spec);
  }
  awaited.reset();
  summary.checkpoint = keeper.last();
  print(comm, options, summary);
  if (!result.failure.empty()) throw core::RunError(result.failure);
  if (!result.save_failure.empty())
    throw core::RunError("the run ended without a checkpoint: " + result.save_failure);
  return result.stopped ? ExitCode::stopped : ExitCode::done;
}

/// Ranks may have other environments.
void set_wait_limit() {
  const char* text = std::getenv("PBMPI_WAIT_LIMIT");
  if (text == nullptr) return;
  const int limit_s = stepping::read_number<int>(text, "PBMPI_WAIT_LIMIT");
  core::require_input(limit_s >= 1, "PBMPI_WAIT_LIMIT is " + std::string(text) + "; give seconds, 1 or more");
  core::set_wait_limit(limit_s);
}

}  // namespace

ExitCode run_pbmpi(const mpi::Communicator& comm, const std::vector<std::string>& args) {
  const double start_s = core::now_s();
  Options options = parse_options(args);
  const auto say = [&](const std::string& text) {
    if (comm.is_root()) std::cout << text << std::flush;
    return ExitCode::done;
  };
  switch (options.action) {
    case Action::help:
      return say(help_of(pbmpi_manual(), args));
    case Action::version:
      return say(version_line("pbmpi") + "\n");
    case Action::list_scenes:
      return say(scene_list());
    case Action::describe:
    case Action::run:
      break;
  }
  const SignalRequests signals;
  mpi::agree_on_errors(comm, set_wait_limit);
  if (comm.is_root()) tell_of_slow_starts(options.common);
  std::optional<core::Awaited> awaited("all ranks to read the scene");
  Work work = options.run.resume ? resumed_work(comm, args, options) : new_work(comm, options);
  Cut cut = decompose(work.spec, mpi::space_costs(model::make_space_map(*work.first_world)), comm.size());
  work.spec.decomposition = cut.decomposition;
  work.spec.groups = std::move(cut.groups);
  awaited.reset();
  if (options.action == Action::run) return simulate(comm, options, std::move(work), signals, start_s);
  const core::Awaited description("root to build all worlds and describe them");
  mpi::agree_on_errors(comm, [&] {
    if (comm.is_root()) say(describe(work, comm.size()));
  });
  return ExitCode::done;
}

}  // namespace pbmpi::app
