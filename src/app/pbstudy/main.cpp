/// pbstudy: runs a matrix of cases over the ranks, and writes the cost and quality of each.
#include <algorithm>
#include <iostream>
#include <string>
#include <string_view>
#include <vector>

#include "app/common/options.h"
#include "app/common/run_program.h"
#include "app/manual/manual.h"
#include "app/pbstudy/accuracy/accuracy_options.h"
#include "app/pbstudy/calibrate/calibrate_cases.h"
#include "app/pbstudy/effects/effects_cases.h"
#include "app/pbstudy/stability/stability_options.h"
#include "app/pbstudy/study/study_runner.h"
#include "core/system/leftovers.h"
#include "core/text.h"
#include "mpi/comm/session.h"

namespace pbmpi::app {
namespace {

/// One study, which reads its own options.
struct StudyCommand {
  std::string_view name;
  std::string_view meaning;  ///< one line for --help
  Study* run;
  Manual (*manual)();
};

const std::vector<StudyCommand>& study_commands() {
  static const std::vector<StudyCommand> commands = {
      {"accuracy", "what accuracy costs in time: errors and times of many settings", run_accuracy,
       accuracy_manual},
      {"calibrate", "what the harness costs beside the physics, for forecasts of more ranks", run_calibrate,
       calibrate_manual},
      {"effects", "what each effect costs, and what leaving it out does to the result", run_effects,
       effects_manual},
      {"stability", "which settings hold the cases that are known to be hard", run_stability,
       stability_manual},
  };
  return commands;
}

std::string unknown_study(const std::string& word) {
  std::vector<std::string> names;
  for (const StudyCommand& command : study_commands()) names.emplace_back(command.name);
  const std::string nearest = core::nearest_name(word, names);
  return "'" + word + "' is no study; " +
         (nearest.empty() ? "see pbstudy --help" : "did you mean " + nearest + "?");
}

bool asks_for_help(const std::vector<std::string>& args) {
  return std::ranges::any_of(help_arguments(args).args,
                             [](const std::string& arg) { return arg == "--help" || arg == "-h"; });
}

/// The manual of pbstudy itself.
Manual pbstudy_manual() {
  boost::program_options::options_description options("Options");
  options.add_options()("help,h", "print this help")("version", "print the version");
  Manual manual{.name = "pbstudy",
                .about =
                    "pbstudy runs a matrix of cases over the MPI ranks, each case a world of its own, and "
                    "writes one HDF5 file.",
                .usage = "mpirun -n RANKS pbstudy STUDY [options]",
                .title = "Studies (pbstudy STUDY --help shows their options)",
                .options = options,
                .exit_codes = common_exit_codes(),
                .files = {{"STUDY.h5", "the study, in HDF5; pbreport shows it"},
                          {"STUDY.h5.cases-RANK", "cases that are done, until the study is complete"}},
                .examples = {"mpirun -n 2 pbstudy accuracy --scene CrashWa"}};
  manual.exit_codes.push_back({"75", "stopped early on request; --resume goes on"});
  for (const StudyCommand& command : study_commands())
    manual.commands.push_back({std::string(command.name), std::string(command.meaning)});
  return manual;
}

/// Collective. Runs the study that args[0] names. Throws core::InputError and core::RunError, the same on
/// every rank.
core::ExitCode run_pbstudy(const mpi::Communicator& comm, const std::vector<std::string>& args) {
  const auto say = [&](const std::string& text) {
    if (comm.is_root()) std::cout << text << std::flush;
    return core::ExitCode::done;
  };
  core::require_input(!args.empty(), "no study is named; name one, e.g. pbstudy accuracy (see --help)");
  const std::string first = help_arguments(args).args.front();
  if (first == "--help" || first == "-h") return say(help_of(pbstudy_manual(), args));
  if (args.front() == "--version") return say(version_line("pbstudy") + "\n");
  for (const StudyCommand& command : study_commands()) {
    if (command.name != args.front()) continue;
    const std::vector<std::string> rest(args.begin() + 1, args.end());
    if (asks_for_help(rest)) return say(help_of(command.manual(), rest));
    try {
      return command.run(comm, rest);
    } catch (const StudyStopped& stopped) {  // on all ranks
      if (comm.is_root()) std::cerr << "pbstudy: " << stopped.message << std::endl;
      return core::ExitCode::stopped;
    }
  }
  throw core::InputError(unknown_study(args.front()));
}

}  // namespace
}  // namespace pbmpi::app

int main(int argc, char** argv) {
  pbmpi::core::remove_leftovers_on_signals();
  const pbmpi::mpi::Session session(argc, argv);
  return pbmpi::app::run_program("pbstudy", [&](const pbmpi::mpi::Communicator& world) {
    return pbmpi::app::run_pbstudy(world, pbmpi::app::arguments(argc, argv));
  });
}
