#include <ostream>

#include <fmt/core.h>

#include "app/common/options.h"
#include "app/common/run_program.h"
#include "app/pbreport/commands.h"
#include "io/repair/repair_run.h"

namespace pbmpi::app {
namespace {

namespace po = boost::program_options;

po::options_description repair_options() {
  po::options_description all("Options");
  add_help_options(all);
  return all;
}

Manual repair_manual() {
  return {.name = "pbreport repair",
          .about =
              "pbreport repair cuts the file of a run that was killed to its committed frames, which stay as "
              "they are, and gives back the disk space behind them. It removes what else the run left beside "
              "the file.",
          .usage = "pbreport repair RUN.h5...",
          .options = repair_options()};
}

}  // namespace

core::ExitCode run_repair(const std::vector<std::string>& args, std::ostream& out) {
  const po::variables_map values = parse_with_files(args, repair_options());
  if (values.count("help") != 0) {
    out << help_of(repair_manual());
    require_printed(out, "the help");
    return core::ExitCode::done;
  }
  core::require_input(values.count("file") != 0,
                      "repair: no file given; name the HDF5 file of a run that was killed");
  for (const std::string& file : given_files(values)) {
    const io::Repair repair = io::repair_run(file);
    constexpr double mebibyte = 1024.0 * 1024.0;
    if (values.count("quiet") == 0) {
      out << file
          << fmt::format(": {} frames are committed; {:.1f} MiB given back\n", repair.frames,
                         static_cast<double>(repair.bytes_freed) / mebibyte);
    }
  }
  require_printed(out, "what was repaired");
  return core::ExitCode::done;
}

}  // namespace pbmpi::app
