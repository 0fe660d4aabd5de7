#include "app/common/python_program.h"

#include <fcntl.h>
#include <signal.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <cstdlib>
#include <filesystem>

#include "core/system/descriptor.h"

namespace pbmpi::app {
namespace {

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

}  // namespace

std::string folder_of_program() { return std::filesystem::read_symlink("/proc/self/exe").parent_path(); }

std::vector<std::string> python_command(const std::string& package, const std::vector<std::string>& words) {
  const char* chosen = std::getenv("PBMPI_PYTHON");
  std::vector<std::string> command = {chosen != nullptr ? chosen : PBMPI_PYTHON, "-B",
                                      folder_of_program() + "/../share/pbmpi/" + package};
  command.insert(command.end(), words.begin(), words.end());
  return command;
}

void become(std::vector<std::string> command) {
  const std::vector<char*> argv = pointers(command);
  execvp(argv.front(), argv.data());
  throw not_started(command.front());
}

int exit_code_of(std::vector<std::string> command, const std::string& output) {
  const std::vector<char*> argv = pointers(command);
  core::Descriptor out;
  if (!output.empty()) out = core::Descriptor(output, O_WRONLY | O_CREAT | O_TRUNC);
  const pid_t pid = output.empty() || out.is_open() ? fork() : -1;
  if (pid < 0) throw not_started(command.front());
  if (pid == 0) {  // nothing may be allocated
    prctl(PR_SET_PDEATHSIG, SIGKILL);
    setpgid(0, 0);
    if (!out.is_open() || dup2(out.get(), STDOUT_FILENO) >= 0) execvp(argv.front(), argv.data());
    _exit(127);
  }
  int status = 0;
  while (waitpid(pid, &status, 0) < 0 && errno == EINTR) {
  }
  return WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
}

core::ExitCode run_report_for(const std::string& output, const std::vector<std::string>& words) {
  const int code = exit_code_of(python_command("reports", words));
  if (code > static_cast<int>(core::ExitCode::bad_input))
    throw core::RunError(output + ": Python, which writes it, was killed or cannot be started (exit code " +
                         std::to_string(code) + "); install Python, or name it in PBMPI_PYTHON");
  return static_cast<core::ExitCode>(code);
}

}  // namespace pbmpi::app
