#include "core/system/child.h"

#include <fcntl.h>
#include <signal.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <chrono>
#include <cstring>
#include <filesystem>
#include <thread>

#include "core/clock.h"
#include "core/error.h"

namespace pbmpi::core {
namespace {

std::vector<std::string> environment_for(const Child& child) {
  std::vector<std::string> all;
  for (char** entry = environ; *entry != nullptr; ++entry) {
    const std::string text = *entry;
    if (!text.starts_with("OMPI_") && !text.starts_with("PMIX_")) all.push_back(text);
  }
  for (const auto& [name, value] : child.environment) {
    std::erase_if(all, [start = name + "="](const std::string& entry) { return entry.starts_with(start); });
    all.push_back(name + "=" + value);
  }
  return all;
}

std::vector<char*> pointers(std::vector<std::string>& texts) {
  std::vector<char*> all;
  all.reserve(texts.size() + 1);
  for (std::string& text : texts) all.push_back(text.data());
  all.push_back(nullptr);
  return all;
}

/// Runs between fork and exec, where nothing may be allocated.
[[noreturn]] void become(char* const* command, char* const* environment, const char* output,
                         const char* errors) {
  prctl(PR_SET_PDEATHSIG, SIGKILL);
  const int flags = O_WRONLY | O_CREAT | O_TRUNC;
  const int out = open(output, flags, 0644), err = open(errors, flags, 0644);
  const int in = open("/dev/null", O_RDONLY);
  if (out >= 0 && err >= 0 && in >= 0 && dup2(out, 1) >= 0 && dup2(err, 2) >= 0 && dup2(in, 0) >= 0)
    execvpe(command[0], command, environment);
  _exit(127);
}

}  // namespace

ChildEnd run_child(const Child& child) {
  std::vector<std::string> command = child.command, environment = environment_for(child);
  const std::vector<char*> argv = pointers(command), envp = pointers(environment);
  const double start_s = now_s();
  const pid_t pid = fork();
  if (pid < 0) throw RunError(command.front() + " cannot be started: " + std::strerror(errno));
  if (pid == 0) become(argv.data(), envp.data(), child.output_file.c_str(), child.error_file.c_str());
  ChildEnd end;
  int status = 0;
  while (waitpid(pid, &status, WNOHANG) == 0) {
    if (!end.timed_out && now_s() - start_s > child.time_limit_s) {
      end.timed_out = true;
      kill(pid, SIGKILL);
    }
    std::this_thread::sleep_for(std::chrono::milliseconds(20));
  }
  end.exit_code = WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
  return end;
}

std::string folder_of_program() { return std::filesystem::read_symlink("/proc/self/exe").parent_path(); }

}  // namespace pbmpi::core
