#include "io/file/output_lock.h"

#include <fcntl.h>
#include <sys/file.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <csignal>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <optional>
#include <sstream>
#include <thread>

#include "core/error.h"
#include "core/hash.h"
#include "core/system/paths.h"

namespace pbmpi::io {
namespace {

namespace fs = std::filesystem;

/// The lock file's record of the process that holds it, or held it when it was killed.
struct Holder {
  long process = 0, parent = 0;
  std::string host, temporary;
};

std::string host_name() {
  std::array<char, 256> name{};
  return gethostname(name.data(), name.size() - 1) == 0 ? name.data() : "unknown";
}

Holder read_holder(const std::string& lock_path) {
  Holder holder;
  std::ifstream file(lock_path);
  file >> holder.process >> holder.parent >> holder.host;
  file.ignore();
  std::getline(file, holder.temporary);
  return holder;
}

/// State and parent of a process of this host, as /proc has them; nothing if there is none.
std::optional<std::pair<char, long>> state_of(long process) {
  std::ifstream file("/proc/" + std::to_string(process) + "/stat");
  std::string text;
  if (!std::getline(file, text) || text.rfind(')') == std::string::npos) return std::nullopt;
  std::istringstream after(text.substr(text.rfind(')') + 1));
  std::pair<char, long> state;
  after >> state.first >> state.second;
  return state;
}

/// Is the holder ending: dead, or without the launcher that started it?
bool is_ending(const Holder& holder) {
  if (holder.host != host_name() || holder.process <= 0) return false;
  const auto state = state_of(holder.process);
  return !state || state->first == 'Z' || state->first == 'X' || state->second != holder.parent;
}

bool is_dead(const Holder& holder) {
  return holder.host == host_name() && holder.process > 0 &&
         kill(static_cast<pid_t>(holder.process), 0) != 0 && errno == ESRCH;
}

std::string name_of(const Holder& holder) {
  if (holder.process == 0) return "another process";
  return "process " + std::to_string(holder.process) + " on host " + holder.host;
}

/// A name for a file next to `path` that belongs to it: prefix + name + suffix, with the name cut where it is
/// too long for a file system.
std::string beside(const std::string& path, const std::string& prefix, const std::string& suffix) {
  constexpr std::size_t longest_name = 255, hash_digits = 16;
  const fs::path file(path);
  std::string name = file.filename().string();
  const std::size_t added = prefix.size() + suffix.size();
  if (name.size() <= longest_name && name.size() + added > longest_name) {
    core::Hash64 hash;
    for (const char letter : name) hash.add(static_cast<std::uint64_t>(static_cast<unsigned char>(letter)));
    name = name.substr(0, longest_name - added - hash_digits) + core::to_hex(hash.value());
  }
  return (file.parent_path() / (prefix + name + suffix)).string();
}

constexpr const char* unfinished_end = ".part";

/// What follows the name of an output in that of a temporary file of a process of this host.
std::string unfinished_begin() { return "." + host_name() + "-"; }

/// Removes a dead holder's temporary file; a name that is no temporary file beside `path` is left alone.
void remove_unfinished(const std::string& path, const Holder& holder) {
  const fs::path temporary = fs::path(path).parent_path() / holder.temporary;
  if (holder.temporary.empty() || holder.temporary.find('/') != std::string::npos ||
      !holder.temporary.ends_with(unfinished_end))
    return;
  unlink(temporary.c_str());
}

/// Removes temporary files of dead processes of this host that no lock file names any more.
void remove_unfinished(const std::string& path) {
  const fs::path file(path);
  const std::string begin = file.filename().string() + unfinished_begin();
  std::error_code ignored;
  for (const auto& entry :
       fs::directory_iterator(file.has_parent_path() ? file.parent_path() : ".", ignored)) {
    const std::string name = entry.path().filename().string();
    if (!name.starts_with(begin) || !name.ends_with(unfinished_end)) continue;
    Holder owner;
    owner.process = std::atol(name.c_str() + begin.size());
    owner.host = host_name();
    if (is_dead(owner)) unlink(entry.path().c_str());
  }
}

/// A pipe, a device or a link in the place of the lock file would lock nothing, or make this process wait.
void require_plain_lock(const std::string& path, const std::string& lock_path) {
  std::error_code ignored;
  const fs::file_status status = fs::symlink_status(lock_path, ignored);
  if (fs::exists(status) && !fs::is_regular_file(status))
    refuse_output(path, lock_path + ", which locks it, is not a regular file", "remove that");
}

}  // namespace

void refuse_output(const std::string& path, const std::string& why, const std::string& advice) {
  throw core::InputError("cannot create " + path + ": " + why + "; " + advice);
}

void refuse_output_in_folder(const std::string& path, int error) {
  refuse_output(path, core::reason_of(error), "give the name of a file in a directory you can write to");
}

OutputLock::OutputLock(const std::string& path, bool has_locks)
    : path_(core::followed(path)),
      lock_path_(beside(path_, ".", ".lock")),
      temporary_path_(beside(path_, "", unfinished_begin() + std::to_string(getpid()) + unfinished_end)) {
  using namespace std::chrono_literals;
  require_plain_lock(path_, lock_path_);
  // 30 s: the ranks of a dead run end 1 to 2 s after it, but on a busy machine have been seen to take over 5
  // s.
  constexpr int most_tries = 600;
  for (int tries = 0;; ++tries) {
    const Taken taken = has_locks ? take() : take_by_name();
    if (taken == Taken::yes) break;
    const Holder holder = read_holder(lock_path_);
    if (tries == most_tries || (taken == Taken::held && !is_ending(holder))) {
      refuse_output(path_, name_of(holder) + " writes it",
                    has_locks ? "wait for it to end, or give another name"
                              : "wait for it to end, or give another name; if that process is gone, remove " +
                                    lock_path_);
    }
    std::this_thread::sleep_for(50ms);
  }
  lock_file_ = core::Leftover(lock_path_);
  remove_unfinished(path_, read_holder(lock_path_));
  remove_unfinished(path_);
  write_record();
  temporary_file_ = core::Leftover(temporary_path_);
}

OutputLock& OutputLock::operator=(OutputLock&& other) noexcept {
  if (this == &other) return *this;
  release();
  path_ = std::move(other.path_);
  lock_path_ = std::move(other.lock_path_);
  temporary_path_ = std::move(other.temporary_path_);
  file_ = std::move(other.file_);
  lock_file_ = std::move(other.lock_file_);
  temporary_file_ = std::move(other.temporary_file_);
  return *this;
}

OutputLock::Taken OutputLock::take() {
  core::Descriptor file(lock_path_, O_CREAT | O_RDWR);
  if (!file.is_open()) refuse_output_in_folder(path_, errno);
  if (flock(file.get(), LOCK_EX | LOCK_NB) != 0) {
    if (errno == EWOULDBLOCK) return Taken::held;
    if (errno == EINTR) return Taken::again;
    // On a file system without locks the contents of the lock file name its holder, so an empty file was just
    // made here.
    if (lseek(file.get(), 0, SEEK_END) == 0) unlink(lock_path_.c_str());
    return take_by_name();
  }
  // The holder removes the file before it frees the lock, in which case this process has locked a removed
  // file.
  if (!file.is_at(lock_path_)) return Taken::again;
  file_ = std::move(file);
  return Taken::yes;
}

OutputLock::Taken OutputLock::take_by_name() {
  core::Descriptor file(lock_path_, O_CREAT | O_EXCL | O_RDWR);
  if (!file.is_open()) {
    const int error = errno;
    if (error != EEXIST) refuse_output_in_folder(path_, error);
    const Holder holder = read_holder(lock_path_);
    if (!is_dead(holder)) return Taken::held;
    remove_unfinished(path_, holder);
    unlink(lock_path_.c_str());
    return Taken::again;
  }
  file_ = std::move(file);
  return Taken::yes;
}

void OutputLock::write_record() {
  const std::string record = std::to_string(getpid()) + " " + std::to_string(getppid()) + " " + host_name() +
                             "\n" + fs::path(temporary_path_).filename().string() + "\n";
  // A full disk may prevent the write; the lock holds nevertheless.
  if (ftruncate(file_.get(), 0) != 0) return;
  static_cast<void>(file_.write(std::as_bytes(std::span(record))));
}

void OutputLock::release() {
  if (!file_.is_open()) return;
  if (file_.is_at(lock_path_)) unlink(lock_path_.c_str());
  lock_file_ = {};
  temporary_file_ = {};
  file_.close();
}

}  // namespace pbmpi::io
