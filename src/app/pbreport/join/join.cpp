#include "app/pbreport/join/join.h"

#include <ostream>

#include <fmt/core.h>

#include "app/common/options.h"
#include "app/common/text_output.h"
#include "io/join/join_runs.h"

namespace pbmpi::app {
namespace {

namespace po = boost::program_options;

po::options_description visible_options() {
  po::options_description all("Options");
  all.add_options()("output,o", po::value<std::string>()->value_name("FILE"), "the file to write")  //
      ("common", "leave out what not all files have, e.g. contacts");
  add_help_options(all);
  all.add_options()("quiet,q", "print nothing but errors");
  return all;
}

std::string to_text(const io::JoinedRun& joined, const std::string& output) {
  std::string text;
  for (const io::JoinedRun::Part& part : joined.parts) {
    text += fmt::format("{}: frames {} to {}, {} of them taken", part.path, part.first_frame,
                        part.first_frame + part.num_frames - 1, part.num_used);
    for (const std::string& one : part.differs) text += "; " + one;
    text += "\n";
  }
  for (const std::string& name : joined.left_out)
    text += "left_out: " + name + ", which not all files have\n";
  return text + fmt::format("{}: frames {} to {}, {}\nstate_hash: {}\n", output, joined.first_frame,
                            joined.first_frame + joined.num_frames - 1,
                            joined.complete ? "complete" : "incomplete",
                            joined.state_hash.empty() ? "none (the run was cut off)" : joined.state_hash);
}

}  // namespace

Manual join_manual() {
  return {.name = "pbreport join",
          .about =
              "pbreport join makes one file of that of a run and those of the runs that went on from its "
              "checkpoints: as if the run had never been stopped. Files may come in any order. Frames that "
              "several of them have (of a run that was killed after its last checkpoint) must be equal bit "
              "for bit, times apart; the later file's are taken.",
          .usage = "pbreport join RUN.h5 RUN.from12.h5... --output ALL.h5 [options]",
          .options = visible_options(),
          .examples = {"pbreport join 100CrSk.h5 100CrSk.from*.h5 -o all.h5"}};
}

core::ExitCode run_join(const std::vector<std::string>& args, std::ostream& out) {
  const po::variables_map values = parse_with_files(args, visible_options());
  if (values.count("help") != 0) {
    out << help_of(join_manual());
    require_printed(out, "the help");
    return core::ExitCode::done;
  }
  const auto output = output_path(values, "output");
  core::require_input(output.has_value(), "join: no place for the joined file; name it with --output FILE");
  const io::JoinedRun joined = io::join_runs(given_files(values), *output, values.count("common") != 0);
  if (values.count("quiet") == 0) out << to_text(joined, *output);
  require_printed(out, "what was joined");
  return core::ExitCode::done;
}

}  // namespace pbmpi::app
