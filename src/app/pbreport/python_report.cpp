#include "app/pbreport/python_report.h"

#include <signal.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <cstdlib>
#include <filesystem>

#include "app/common/options.h"
#include "core/system/descriptor.h"
#include "io/hdf5/file_types.h"
#include "io/run/run_data.h"
#include "io/table/table_file.h"

namespace pbmpi::app {
namespace {

/// The command that runs the package "reports" with these words, and tells it whose it is:
/// share/pbmpi/reports, in a build as where it is installed.
std::vector<std::string> command_of(const std::vector<std::string>& words) {
  setenv("PBREPORT_VERSION", version_line("pbreport").c_str(), 1);
  const char* chosen = std::getenv("PBMPI_PYTHON");
  const auto programs = std::filesystem::read_symlink("/proc/self/exe").parent_path();
  std::vector<std::string> command = {chosen != nullptr ? chosen : PBMPI_PYTHON, "-B",
                                      programs.string() + "/../share/pbmpi/reports"};
  command.insert(command.end(), words.begin(), words.end());
  return command;
}

std::vector<char*> pointers(std::vector<std::string>& texts) {
  std::vector<char*> all;
  all.reserve(texts.size() + 1);
  for (std::string& text : texts) all.push_back(text.data());
  all.push_back(nullptr);
  return all;
}

core::RunError not_started(const std::string& program) {
  return core::RunError(program + " cannot be started (" + core::reason_of(errno) +
                        "): this is a Python program; install Python, or name it in PBMPI_PYTHON");
}

/// Runs another program to its end: its exit code, or 128 and the signal that ended it; 127 if it cannot be
/// started.
int exit_code_of(std::vector<std::string> command) {
  const std::vector<char*> argv = pointers(command);
  const pid_t pid = fork();
  if (pid < 0) throw not_started(command.front());
  if (pid == 0) {  // nothing may be allocated
    prctl(PR_SET_PDEATHSIG, SIGKILL);
    setpgid(0, 0);
    execvp(argv.front(), argv.data());
    _exit(127);
  }
  int status = 0;
  while (waitpid(pid, &status, 0) < 0 && errno == EINTR) {
  }
  return WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
}

void require_sound(const std::string& path) {
  const std::string filetype = io::filetype_of(path);
  if (filetype == io::study_filetype) io::read_table_file(path, io::study_filetype);
  if (filetype == io::filetype) io::require_sound_run(path);
}

/// Of all words that may name a file: A, --option=A.
void require_sound_files(const std::vector<std::string>& args) {
  for (const std::string& arg : args) {
    const std::size_t equals = arg.starts_with("-") ? arg.find('=') : std::string::npos;
    const std::string value = equals == std::string::npos ? arg : arg.substr(equals + 1);
    if (!value.empty() && !value.starts_with("-")) require_sound(value);
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
  std::vector<std::string> words = {command};
  words.insert(words.end(), args.begin(), args.end());
  std::vector<std::string> report = command_of(words);
  const std::vector<char*> argv = pointers(report);
  execvp(argv.front(), argv.data());
  throw not_started(report.front());
}

core::ExitCode run_report_for(const std::string& output, const std::vector<std::string>& words) {
  const int code = exit_code_of(command_of(words));
  if (code > static_cast<int>(core::ExitCode::bad_input))
    throw core::RunError(output + ": Python, which writes it, was killed or cannot be started (exit code " +
                         std::to_string(code) + "); install Python, or name it in PBMPI_PYTHON");
  return static_cast<core::ExitCode>(code);
}

}  // namespace pbmpi::app
