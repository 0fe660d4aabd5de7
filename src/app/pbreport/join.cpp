#include <sys/stat.h>

#include <algorithm>
#include <ostream>

#include "app/common/options.h"
#include "app/common/run_program.h"
#include "app/pbreport/commands.h"
#include "app/pbreport/python_report.h"
#include "io/file/output_target.h"
#include "io/hdf5/file_types.h"
#include "io/run/run_data.h"
#include "io/table/table_file.h"

namespace pbmpi::app {
namespace {

namespace po = boost::program_options;

po::options_description join_options() {
  po::options_description all("Options");
  all.add_options()("output,o", po::value<std::string>()->value_name("FILE"), "the file to write")  //
      ("common", "leave out what not all files have, e.g. contacts");
  add_help_options(all);
  return all;
}

/// Bytes of the files on the disk: the file of a killed run is as long as the run was planned to be.
std::int64_t bytes_of(const std::vector<std::string>& paths) {
  constexpr std::int64_t block_bytes = 512;
  std::int64_t bytes = 0;
  for (const std::string& path : paths) {
    struct stat status {};
    if (stat(path.c_str(), &status) == 0)
      bytes += std::min<std::int64_t>(status.st_size, block_bytes * status.st_blocks);
  }
  return bytes;
}

/// Adds the checksums to a file that Python has written, and gives it its name.
void publish(io::OutputTarget& target, const std::string& output) {
  try {
    io::store_checksums(target.temporary_path());
    target.publish();
  } catch (const core::RunError& error) {
    throw core::RunError("cannot write " + output + ": " + error.what());
  }
}

Manual join_manual() {
  return {.name = "pbreport join",
          .about =
              "pbreport join makes one file of that of a run and those of the runs that went on from its "
              "checkpoints: as if the run had never been stopped. Files may come in any order. Frames that "
              "several of them have (of a run that was killed after its last checkpoint) must be equal bit "
              "for bit, times apart; the later file's are taken.",
          .usage = "pbreport join RUN.h5 RUN.from12.h5... --output ALL.h5 [options]",
          .options = join_options(),
          .examples = {"pbreport join 100CrSk.h5 100CrSk.from*.h5 -o all.h5"}};
}

}  // namespace

core::ExitCode run_join(const std::vector<std::string>& args, std::ostream& out) {
  const po::variables_map values = parse_with_files(args, join_options());
  if (values.count("help") != 0) {
    out << help_of(join_manual());
    require_printed(out, "the help");
    return core::ExitCode::done;
  }
  const auto output = output_path(values, "output");
  core::require_input(output.has_value(), "join: no place for the joined file; name it with --output FILE");
  const std::vector<std::string> files = given_files(values);
  core::require_input(files.size() > 1, "join: name two files or more, of a run and of what went on from it");
  for (const std::string& file : files) io::require_sound_run(file);
  io::OutputTarget target = io::output_target(*output, io::filetype, bytes_of(files));
  std::vector<std::string> words = {"join", target.temporary_path(), *output,
                                    values.count("common") != 0 ? "common" : "all",
                                    values.count("quiet") != 0 ? "quiet" : "loud"};
  words.insert(words.end(), files.begin(), files.end());
  const core::ExitCode code = run_report_for(*output, words);
  if (code == core::ExitCode::done) publish(target, *output);
  return code;
}

}  // namespace pbmpi::app
