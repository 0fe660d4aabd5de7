#include "app/pbreport/isolated.h"

#include <signal.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <iostream>

#include "core/error.h"

namespace pbmpi::app {
namespace {

[[noreturn]] void run_child(const std::function<int()>& work, pid_t parent) {
  // A signal that ends the parent is meant for the report.
  prctl(PR_SET_PDEATHSIG, SIGTERM);
  if (getppid() != parent) _exit(1);
  const rlimit no_core = {0, 0};
  setrlimit(RLIMIT_CORE, &no_core);
  const int code = work();
  std::cout.flush();
  std::cerr.flush();
  _exit(code);
}

bool is_crash(int number) {
  constexpr std::array crashes = {SIGSEGV, SIGBUS, SIGFPE, SIGILL, SIGABRT};
  return std::ranges::find(crashes, number) != crashes.end();
}

}  // namespace

int run_isolated(const std::function<int()>& work) {
  std::cout.flush();
  const pid_t parent = getpid(), child = fork();
  if (child < 0) return work();
  if (child == 0) run_child(work, parent);
  int status = 0;
  while (waitpid(child, &status, 0) < 0) {
    if (errno != EINTR) return static_cast<int>(core::ExitCode::failed);
  }
  if (WIFEXITED(status)) return WEXITSTATUS(status);
  const int number = WTERMSIG(status);
  if (is_crash(number)) {
    std::cerr << "pbreport: a file cannot be read: the HDF5 library crashed over it (signal " << number
              << "); the file is damaged" << std::endl;
    return static_cast<int>(core::ExitCode::bad_input);
  }
  signal(number, SIG_DFL);
  raise(number);
  return static_cast<int>(core::ExitCode::failed);
}

}  // namespace pbmpi::app
