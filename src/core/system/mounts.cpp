#include "core/system/mounts.h"

#include <fcntl.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <chrono>
#include <csignal>
#include <filesystem>
#include <thread>
#include <vector>

#include "core/error.h"
#include "core/system/paths.h"

namespace pbmpi::core {
namespace {

using namespace std::chrono_literals;
using Clock = std::chrono::steady_clock;

/// An automounter takes some seconds until it has mounted; a person who waits longer takes the program for
/// hung.
constexpr auto longest_answer = 10s;

/// What a child is started with: no output, and no descriptor of this process, which a launcher would wait
/// for.
class Spawning {
 public:
  Spawning() {
    posix_spawn_file_actions_init(&actions_);
    for (const int standard : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO})
      posix_spawn_file_actions_addopen(&actions_, standard, "/dev/null", O_RDWR, 0);
    posix_spawn_file_actions_addclosefrom_np(&actions_, STDERR_FILENO + 1);
  }
  ~Spawning() { posix_spawn_file_actions_destroy(&actions_); }
  Spawning(const Spawning&) = delete;
  Spawning& operator=(const Spawning&) = delete;

  const posix_spawn_file_actions_t* actions() const { return &actions_; }

 private:
  posix_spawn_file_actions_t actions_{};
};

/// Starts a process that asks the file systems of a path and of its folder for their state, of which no cache
/// knows; returns its id, or 0 where it cannot be started.
pid_t ask(const std::string& path) {
  const Spawning spawning;
  const std::string folder = std::filesystem::path(path).parent_path().string();
  std::array<std::string, 5> words = {"stat", "-f", "--", path, folder.empty() ? "." : folder};
  std::array<char*, words.size() + 1> arguments{};
  for (std::size_t i = 0; i < words.size(); ++i) arguments[i] = words[i].data();
  pid_t child = 0;
  const int error =
      posix_spawn(&child, "/usr/bin/stat", spawning.actions(), nullptr, arguments.data(), environ);
  return error == 0 ? child : 0;
}

/// Has the child ended by then?
bool ends(pid_t child, Clock::time_point deadline) {
  while (child != 0 && waitpid(child, nullptr, WNOHANG) == 0) {
    if (Clock::now() > deadline) return false;
    std::this_thread::sleep_for(500us);
  }
  return true;
}

}  // namespace

void require_answers(std::span<const NamedPath> paths) {
  std::vector<pid_t> children;
  children.reserve(paths.size());
  for (const NamedPath& path : paths) children.push_back(ask(path.path));
  const Clock::time_point deadline = Clock::now() + longest_answer;
  const NamedPath* silent = nullptr;
  for (std::size_t i = 0; i < paths.size(); ++i) {
    if (ends(children[i], deadline)) continue;
    kill(children[i], SIGKILL);
    if (silent == nullptr) silent = &paths[i];
  }
  if (silent == nullptr) return;
  throw InputError(silent->option + " " + silent->path + ": its file system has not answered for " +
                   std::to_string(longest_answer.count()) +
                   " s, as if its server were gone; try `df` on its folder, and mount it anew or name a file "
                   "elsewhere");
}

}  // namespace pbmpi::core
