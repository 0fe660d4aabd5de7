#include "app/pbreport/commands.h"

#include <algorithm>

#include "app/pbreport/report.h"

namespace pbmpi::app {

const std::vector<ReportCommand>& report_commands() {
  static const std::vector<ReportCommand> commands = {
      {"report", "the summary of one run, its HTML page, its ParaView sidecar (the default)", run_report},
  };
  return commands;
}

core::ExitCode run_pbreport(const std::vector<std::string>& args, std::ostream& out) {
  const auto& commands = report_commands();
  const auto named = args.empty()
                         ? commands.end()
                         : std::find_if(commands.begin(), commands.end(),
                                        [&](const ReportCommand& c) { return c.name == args.front(); });
  if (named == commands.end()) return commands.front().run(args, out);
  return named->run({args.begin() + 1, args.end()}, out);
}

}  // namespace pbmpi::app
