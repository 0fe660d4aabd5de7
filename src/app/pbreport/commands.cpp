#include "app/pbreport/commands.h"

#include <algorithm>
#include <ostream>

#include "app/pbreport/python_report.h"
#include "app/pbreport/run_report.h"
#include "core/system/mounts.h"
#include "core/system/paths.h"

namespace pbmpi::app {
namespace {

/// Any word may name a file, which is looked into to find out what is to be reported.
void require_answers_to(const std::vector<std::string>& args) {
  std::vector<core::NamedPath> paths;
  paths.reserve(args.size());
  for (const std::string& arg : args) {
    const std::size_t begin = arg.starts_with('-') ? arg.find('=') + 1 : 0;  // --html=FILE
    const bool is_option = begin == 0 && arg.starts_with('-');
    if (!is_option && begin < arg.size()) paths.push_back({"the path", arg.substr(begin), false});
  }
  core::require_answers(paths);
}

/// Runs "pbreport [report] FILE", whose help is the program's.
core::ExitCode run_first_command(const std::vector<std::string>& args, std::ostream& out) {
  const ReportOptions options = parse_report_options(args);
  if (options.action != ReportAction::help) return run_report(options, out);
  out << help_of(pbreport_manual(), args);
  return core::ExitCode::done;
}

}  // namespace

const std::vector<ReportCommand>& report_commands() {
  static const std::vector<ReportCommand> commands = {
      {"report", "the summary of one run, its HTML page, its ParaView sidecar (the default)",
       run_first_command},
      {"diff", "how far two recorded runs of the same bodies are apart"},
      {"study", "what accuracy costs in time: the file of pbstudy, and the setting for a budget"},
      {"effects", "what effects cost: the file of pbstudy effects"},
      {"stability", "which settings hold the hard cases: the file of pbstudy stability"},
      {"engines", "engines side by side: files of pbstudy accuracy and pbstudy stability"},
      {"csv", "a table of a run as comma-separated values: bodies, observables, timings, events ..."},
      {"ensemble", "mean, spread and quantiles over runs that differ in their seeds"},
      {"scaling", "what more ranks bring: runs of the same work on different numbers of ranks"},
      {"calibrate", "what the harness costs, forecast for more ranks: the file of pbstudy calibrate"},
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
                .basic = {"json", "html", "xdmf", "quiet"},
                .exit_codes = common_exit_codes(),
                .examples = {"pbreport 100CrSk.h5", "pbreport 100CrSk.h5 --html 100CrSk.html",
                             "pbreport 100CrSk.h5 --json | jq .frame_rate"}};
  for (const ReportCommand& command : report_commands())
    manual.commands.push_back({std::string(command.name), std::string(command.meaning)});
  return manual;
}

core::ExitCode run_pbreport(const std::vector<std::string>& args, std::ostream& out) {
  require_answers_to(args);
  const auto& commands = report_commands();
  const std::string first = args.empty() ? "" : args.front();
  const auto named = std::ranges::find(commands, first, &ReportCommand::name);
  if (named == commands.end()) {
    const std::string report = report_of_study_in(args);
    return report.empty() ? commands.front().run(args, out) : run_python_report(report, args);
  }
  const std::vector<std::string> rest(args.begin() + 1, args.end());
  return named->run != nullptr ? named->run(rest, out) : run_python_report(first, rest);
}

}  // namespace pbmpi::app
