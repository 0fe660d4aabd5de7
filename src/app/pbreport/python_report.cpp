#include "app/pbreport/python_report.h"

#include <unistd.h>

#include <cerrno>
#include <cstdlib>
#include <cstring>

#include "app/common/options.h"
#include "core/system/child.h"
#include "io/hdf5/file_types.h"
#include "io/run/run_data.h"
#include "io/table/table_file.h"

namespace pbmpi::app {
namespace {

void require_sound_files(const std::vector<std::string>& args) {
  for (const std::string& arg : args) {
    if (arg.empty() || arg.front() == '-') continue;
    const std::string filetype = io::filetype_of(arg);
    if (filetype == io::study_filetype) io::read_table_file(arg, io::study_filetype);
    if (filetype == io::filetype) io::require_sound_run(arg);
  }
}

/// Beside the program, in a build as where it is installed.
std::string package_folder() { return core::folder_of_program() + "/../share/pbmpi/reports"; }

}  // namespace

std::string report_of_study_in(const std::vector<std::string>& args) {
  for (const std::string& arg : args) {
    if (arg.empty() || arg.front() == '-' || io::filetype_of(arg) != io::study_filetype) continue;
    const std::string study = io::root_text(arg, "study");
    core::require_input(study != "prediction",
                        arg + ": a study of prediction; jobs/paper/paper.py prediction FILE shows it");
    // The first version of the files had only accuracy studies, and did not say so.
    return study.empty() || study == "accuracy" ? "study" : study;
  }
  return {};
}

core::ExitCode run_python_report(const std::string& command, const std::vector<std::string>& args) {
  require_sound_files(args);
  const char* chosen = std::getenv("PBMPI_PYTHON");
  std::vector<std::string> words = {chosen != nullptr ? chosen : PBMPI_PYTHON, "-B", package_folder(),
                                    command};
  words.insert(words.end(), args.begin(), args.end());
  std::vector<char*> pointers;
  pointers.reserve(words.size() + 1);
  for (std::string& word : words) pointers.push_back(word.data());
  pointers.push_back(nullptr);
  setenv("PBREPORT_VERSION", version_line("pbreport").c_str(), 1);
  execvp(pointers.front(), pointers.data());
  throw core::RunError(words.front() + " cannot be started (" + std::strerror(errno) +
                       "): this report is a Python program; install Python, or name it in PBMPI_PYTHON");
}

}  // namespace pbmpi::app
