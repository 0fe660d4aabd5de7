#include "app/pbreport/commands.h"

#include <algorithm>

#include "app/pbreport/diff.h"
#include "app/pbreport/effects.h"
#include "app/pbreport/figures.h"
#include "app/pbreport/report.h"
#include "app/pbreport/study.h"
#include "app/pbreport/suite_commands.h"

namespace pbmpi::app {
namespace {

using Run = core::ExitCode (*)(const std::vector<std::string>& args, std::ostream& out);

/// Files say what they are.
Run command_for_the_files_of(const std::vector<std::string>& args) {
  if (names_an_effect_study(args)) return run_effects_report;
  return names_a_study(args) ? run_study : report_commands().front().run;
}

}  // namespace

const std::vector<ReportCommand>& report_commands() {
  static const std::vector<ReportCommand> commands = {
      {"report", "the summary of one run, its HTML page, its ParaView sidecar (the default)", run_report},
      {"islands", "the paper's Table 1 from runs", run_islands},
      {"cores", "the paper's Table 2 and Figure 6 from runs with --record-islands", run_cores},
      {"figure6", "one page of both, from such runs", run_figure6},
      {"diff", "how far two recorded runs of the same bodies are apart", run_diff},
      {"figures", "figures 8 and 9 of the paper from recorded runs", run_figures},
      {"study", "what accuracy costs in time: the file of pbstudy, and the setting for a budget", run_study},
      {"effects", "what effects cost: the file of pbstudy effects", run_effects_report},
  };
  return commands;
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
