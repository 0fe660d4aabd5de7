#include "app/pbreport/python_report.h"

#include <cstdlib>
#include <sstream>

#include "app/common/options.h"
#include "app/common/python_program.h"
#include "core/system/input_file.h"
#include "io/hdf5/file_types.h"
#include "io/run/run_data.h"
#include "io/table/table_file.h"

namespace pbmpi::app {
namespace {

void require_sound(const std::string& path) {
  const std::string filetype = io::filetype_of(path);
  if (filetype == io::study_filetype) io::read_table_file(path, io::study_filetype);
  if (filetype == io::filetype) io::require_sound_run(path);
}

/// Of all words that may name a file: A, --option=A, and those of a file of options.
void require_sound_files(const std::vector<std::string>& args) {
  bool is_config = false;
  for (const std::string& arg : args) {
    const std::size_t equals = arg.starts_with("-") ? arg.find('=') : std::string::npos;
    const std::string value = equals == std::string::npos ? arg : arg.substr(equals + 1);
    if (value.empty() || value.starts_with("-")) {
      is_config = value == "--config";
      continue;
    }
    require_sound(value);
    if (is_config || arg.starts_with("--config=")) {
      std::istringstream words(core::read_input_file(value, "--config wants a file of 'name = value' lines"));
      for (std::string word; words >> word;) {
        const std::string file = word.substr(word.find('=') + 1);
        if (!file.empty()) require_sound(file);
      }
    }
    is_config = false;
  }
}

}  // namespace

std::string report_of_study_in(const std::vector<std::string>& args) {
  for (std::size_t i = 0; i < args.size(); ++i) {
    const std::string& arg = args[i];
    const bool is_beside =
        i > 0 && args[i - 1] == "--hard-cases";  // another study, which the report looks up
    if (is_beside || arg.empty() || arg.front() == '-' || io::filetype_of(arg) != io::study_filetype)
      continue;
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
  setenv("PBREPORT_VERSION", version_line("pbreport").c_str(), 1);
  std::vector<std::string> words = {command};
  words.insert(words.end(), args.begin(), args.end());
  become(python_command("reports", words));
}

}  // namespace pbmpi::app
