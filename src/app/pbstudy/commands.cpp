#include "app/pbstudy/commands.h"

#include <algorithm>
#include <iostream>

#include "app/common/options.h"
#include "app/pbstudy/accuracy/accuracy.h"
#include "app/pbstudy/effects/effects.h"
#include "app/pbstudy/prediction/prediction.h"
#include "app/pbstudy/stability/stability.h"
#include "core/text.h"

namespace pbmpi::app {
namespace {

std::string help_text() {
  std::string text =
      "pbstudy runs a matrix of cases over the MPI ranks, each case a world of its own, and writes one HDF5 "
      "file.\n\n"
      "Usage: mpirun -n RANKS pbstudy STUDY [options]\n\nStudies (pbstudy STUDY --help shows their "
      "options):\n";
  for (const StudyCommand& command : study_commands()) {
    text += "  " + std::string(command.name) +
            std::string(12 - std::min<std::size_t>(11, command.name.size()), ' ') +
            std::string(command.meaning) + "\n";
  }
  return text + "\nOptions:\n  -h [ --help ]   print this help\n  --version       print the version\n" +
         "\nExit codes: 0 done; 1 failed; 2 bad usage or bad input.\n"
         "Example: mpirun -n 2 pbstudy accuracy --scene CrashWa\n";
}

std::string unknown_study(const std::string& word) {
  std::vector<std::string> names;
  for (const StudyCommand& command : study_commands()) names.emplace_back(command.name);
  const std::string nearest = core::nearest_name(word, names);
  return "'" + word + "' is no study; " +
         (nearest.empty() ? "see pbstudy --help" : "did you mean " + nearest + "?");
}

}  // namespace

const std::vector<StudyCommand>& study_commands() {
  static const std::vector<StudyCommand> commands = {
      {"accuracy", "what accuracy costs in time: errors and times of many settings", run_accuracy},
      {"effects", "what each effect costs, and what leaving it out does to the result", run_effects},
      {"prediction", "what value prediction gains a frame, and what it does to the result (Valgrind)",
       run_prediction},
      {"stability", "which settings hold the cases that are known to be hard", run_stability},
  };
  return commands;
}

core::ExitCode run_pbstudy(const mpi::Communicator& comm, const std::vector<std::string>& args) {
  const auto say = [&](const std::string& text) {
    if (comm.is_root()) std::cout << text << std::flush;
    return core::ExitCode::done;
  };
  core::require_input(!args.empty(), "no study is named; name one, e.g. pbstudy accuracy (see --help)");
  if (args.front() == "--help" || args.front() == "-h") return say(help_text());
  if (args.front() == "--version") return say(version_line("pbstudy") + "\n");
  for (const StudyCommand& command : study_commands()) {
    if (command.name == args.front()) return command.run(comm, {args.begin() + 1, args.end()});
  }
  throw core::InputError(unknown_study(args.front()));
}

}  // namespace pbmpi::app
