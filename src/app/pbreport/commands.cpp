#include "app/pbreport/commands.h"

#include <algorithm>
#include <ostream>

#include "app/pbreport/accuracy/study.h"
#include "app/pbreport/accuracy/study_options.h"
#include "app/pbreport/calibrate/calibrate_report.h"
#include "app/pbreport/csv/csv.h"
#include "app/pbreport/csv/csv_options.h"
#include "app/pbreport/diff/diff.h"
#include "app/pbreport/diff/diff_options.h"
#include "app/pbreport/effects/effects.h"
#include "app/pbreport/engines/engines.h"
#include "app/pbreport/ensemble/ensemble.h"
#include "app/pbreport/ensemble/ensemble_options.h"
#include "app/pbreport/join/join.h"
#include "app/pbreport/repair/repair.h"
#include "app/pbreport/run/options.h"
#include "app/pbreport/run/report.h"
#include "app/pbreport/scaling/scaling.h"
#include "app/pbreport/scaling/scaling_options.h"
#include "app/pbreport/stability/stability.h"
#include "app/pbreport/study/study_file.h"
#include "app/pbreport/suite/islands.h"

namespace pbmpi::app {
namespace {

/// Runs "pbreport [report] FILE", whose help is the program's.
core::ExitCode run_first_command(const std::vector<std::string>& args, std::ostream& out) {
  const ReportOptions options = parse_report_options(args);
  if (options.action != ReportAction::help) return run_report(options, out);
  out << help_of(pbreport_manual(), args);
  return core::ExitCode::done;
}

/// Names the script that shows a study of prediction.
core::ExitCode refuse_prediction(const std::vector<std::string>&, std::ostream&) {
  throw core::InputError("a study of prediction: jobs/paper/paper.py prediction FILE shows it");
}

using Run = core::ExitCode (*)(const std::vector<std::string>& args, std::ostream& out);

/// The command for the kind of the files named in the arguments.
Run command_for_the_files_of(const std::vector<std::string>& args) {
  const std::string study = study_named_in(args);
  if (study == "calibrate") return run_calibrate_report;
  if (study == "effects") return run_effects_report;
  if (study == "prediction") return refuse_prediction;
  if (study == "stability") return run_stability_report;
  return study.empty() ? report_commands().front().run : run_study;
}

}  // namespace

const std::vector<ReportCommand>& report_commands() {
  static const std::vector<ReportCommand> commands = {
      {"report", "the summary of one run, its HTML page, its ParaView sidecar (the default)",
       run_first_command},
      {"islands", "the paper's Table 1 from runs", run_islands},
      {"diff", "how far two recorded runs of the same bodies are apart", run_diff},
      {"study", "what accuracy costs in time: the file of pbstudy, and the setting for a budget", run_study},
      {"effects", "what effects cost: the file of pbstudy effects", run_effects_report},
      {"stability", "which settings hold the hard cases: the file of pbstudy stability",
       run_stability_report},
      {"engines", "engines side by side: files of pbstudy accuracy and pbstudy stability", run_engines},
      {"csv", "a table of a run as comma-separated values: bodies, observables, timings, events ...",
       run_csv},
      {"ensemble", "mean, spread and quantiles over runs that differ in their seeds", run_ensemble},
      {"scaling", "what more ranks bring: runs of the same work on different numbers of ranks", run_scaling},
      {"calibrate", "what the harness costs, forecast for more ranks: the file of pbstudy calibrate",
       run_calibrate_report},
      {"join", "a run and what went on from its checkpoints as one file", run_join},
      {"repair", "gives back the disk space that a killed run keeps", run_repair},
  };
  return commands;
}

Manual pbreport_manual() {
  Manual manual{.name = "pbreport",
                .about = "pbreport shows what a run of pbmpi amounts to.",
                .usage = "pbreport [COMMAND] FILE [options]",
                .title = "Commands (pbreport COMMAND --help shows their options)",
                .options = report_options_description(),
                .basic = {"json", "html", "xdmf", "config", "quiet"},
                .exit_codes = common_exit_codes(),
                .examples = {"pbreport 100CrSk.h5", "pbreport 100CrSk.h5 --html 100CrSk.html",
                             "pbreport 100CrSk.h5 --json | jq .frame_rate"}};
  for (const ReportCommand& command : report_commands())
    manual.commands.push_back({std::string(command.name), std::string(command.meaning)});
  return manual;
}

core::ExitCode run_pbreport(const std::vector<std::string>& args, std::ostream& out) {
  const auto& commands = report_commands();
  const auto named = args.empty()
                         ? commands.end()
                         : std::find_if(commands.begin(), commands.end(),
                                        [&](const ReportCommand& c) { return c.name == args.front(); });
  if (named == commands.end()) return command_for_the_files_of(args)(args, out);
  return named->run({args.begin() + 1, args.end()}, out);
}

}  // namespace pbmpi::app
