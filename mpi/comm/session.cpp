#include "mpi/comm/session.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <csignal>
#include <cstdlib>
#include <exception>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <set>
#include <span>
#include <sstream>

#include "core/system/awaited.h"
#include "core/system/descriptor.h"
#include "mpi/comm/check.h"

namespace pbmpi::mpi {
namespace {

namespace fs = std::filesystem;

constexpr const char* folder = "/dev/shm/";

/// Processes have the same numbers in another PID namespace, such as a container's.
std::string record_begin() {
  struct stat status {};
  const bool known = stat("/proc/self/ns/pid", &status) == 0;
  return "pbmpi-segments-" + std::to_string(known ? status.st_ino : 0) + "-";
}

/// Names of the files of /dev/shm that this process has mapped, sorted.
std::vector<std::string> mapped_segments() {
  std::set<std::string> names;
  std::ifstream maps("/proc/self/maps");
  for (std::string line; std::getline(maps, line);) {
    const std::size_t path = line.find(folder);
    if (path != std::string::npos) names.insert(line.substr(path + std::string(folder).size()));
  }
  return {names.begin(), names.end()};
}

/// The names in a record; none unless it is a file of this user.
std::vector<std::string> names_in(const std::string& record) {
  const core::Descriptor file(record, O_RDONLY | O_NOFOLLOW | O_NONBLOCK);
  struct stat status {};
  if (!file.is_open() || fstat(file.get(), &status) != 0 || !S_ISREG(status.st_mode) ||
      status.st_uid != geteuid())
    return {};
  std::vector<std::string> names;
  std::ifstream lines("/proc/self/fd/" + std::to_string(file.get()));
  for (std::string name; std::getline(lines, name);) {
    if (!name.empty() && name.find('/') == std::string::npos) names.push_back(name);
  }
  return names;
}

void remove_dead() {
  const std::string begin = record_begin();
  std::set<std::string> dead, alive;
  std::error_code ignored;
  for (const auto& entry : fs::directory_iterator(folder, ignored)) {
    const std::string name = entry.path().filename().string();
    if (!name.starts_with(begin)) continue;
    const long process = std::atol(name.c_str() + begin.size());
    const bool is_dead = process > 0 && kill(static_cast<pid_t>(process), 0) != 0 && errno == ESRCH;
    const std::vector<std::string> names = names_in(entry.path());
    (is_dead ? dead : alive).insert(names.begin(), names.end());
    if (is_dead && !names.empty()) dead.insert(name);
  }
  for (const std::string& name : dead) {  // ranks of one run map each other's segments
    if (!alive.contains(name)) unlink((folder + name).c_str());
  }
}

/// Makes Open MPI open files without shared file pointers, which nothing here uses: the component "sm"
/// creates a semaphore on the host that is named after the last part of the file's name. A semaphore held by
/// a killed run makes each later run of that name wait for ever, and two runs of one name share it. Files are
/// opened without shared pointers if the only component of that framework has a negative priority; without
/// any component they could not be opened.
void do_without_shared_file_pointers() {
  setenv("OMPI_MCA_sharedfp", "sm", 1);
  setenv("OMPI_MCA_sharedfp_sm_priority", "-1", 1);
}

}  // namespace

SharedSegments::SharedSegments() {
  remove_dead();
  before_ = mapped_segments();
}

void SharedSegments::record() {
  const std::vector<std::string> now = mapped_segments();
  std::vector<std::string> made;
  std::ranges::set_difference(now, before_, std::back_inserter(made));
  if (made.empty()) return;
  const std::string path = folder + record_begin() + std::to_string(getpid());
  unlink(path.c_str());  // of a dead process with this number
  const core::Descriptor file(path, O_WRONLY | O_CREAT | O_EXCL);
  if (!file.is_open()) return;
  record_ = path;
  std::string text;
  for (const std::string& name : made) text += name + "\n";
  static_cast<void>(file.write(std::as_bytes(std::span(text))));
}

void SharedSegments::forget() {
  if (!record_.empty()) unlink(record_.c_str());
}

Session::Session(int& argc, char**& argv) : exceptions_at_start_(std::uncaught_exceptions()) {
  do_without_shared_file_pointers();
  const core::Awaited all_ranks("all ranks to start (MPI_Init)");
  int provided = 0;
  // Before MPI_Init there is no error handler to set: MPI aborts by itself if it cannot start.
  check(MPI_Init_thread(&argc, &argv, MPI_THREAD_FUNNELED, &provided), "MPI_Init_thread");
  check(MPI_Comm_set_errhandler(MPI_COMM_WORLD, MPI_ERRORS_RETURN), "MPI_Comm_set_errhandler");
  check(MPI_Comm_set_errhandler(MPI_COMM_SELF, MPI_ERRORS_RETURN), "MPI_Comm_set_errhandler");
  segments_.record();
}

Session::~Session() {
  if (std::uncaught_exceptions() > exceptions_at_start_) return;
  const core::Awaited all_ranks("all ranks to end (MPI_Finalize)");
  MPI_Finalize();  // a destructor has nobody to report an error to
  segments_.forget();
}

void Session::abort(int exit_code) {
  MPI_Abort(MPI_COMM_WORLD, exit_code);
  std::_Exit(exit_code);  // MPI_Abort does not promise not to return
}

std::string library_version() {
  char text[MPI_MAX_LIBRARY_VERSION_STRING] = "";
  int length = 0;
  check(MPI_Get_library_version(text, &length), "MPI_Get_library_version");
  const std::string version(text, length);
  return version.substr(0, version.find_first_of(",\n"));
}

}  // namespace pbmpi::mpi
