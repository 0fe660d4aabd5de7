#include "core/system/paths.h"

#include <sys/stat.h>

#include <filesystem>
#include <system_error>

#include "core/error.h"
#include "core/system/mounts.h"

namespace pbmpi::core {
namespace {

namespace fs = std::filesystem;

bool is_stream(const struct stat& status) { return !S_ISREG(status.st_mode) && !S_ISDIR(status.st_mode); }

bool is_there(const std::string& path) {
  std::error_code error;
  return fs::exists(path, error);
}

/// Where a file would be created; if the file system refuses the name, e.g. because it is too long, the name
/// as written.
fs::path place_of(const std::string& path) {
  const fs::path absolute = fs::absolute(followed(path));
  std::error_code error;
  fs::path place = fs::weakly_canonical(absolute, error);
  return error ? absolute.lexically_normal() : place;
}

}  // namespace

std::string followed(const std::string& path) {
  constexpr int most_links = 40;  // as many as Linux follows
  fs::path current = path;
  std::error_code error;
  for (int i = 0; i < most_links; ++i) {
    if (!fs::is_symlink(current, error)) return current.string();
    const fs::path target = fs::read_symlink(current, error);
    if (error) return current.string();
    current = target.is_absolute() ? target : current.parent_path() / target;
  }
  throw InputError(path + ": links that go round in a circle; name the file itself");
}

bool is_same_file(const std::string& a, const std::string& b) {
  struct stat of_a {
  }, of_b{};
  const bool has_a = stat(a.c_str(), &of_a) == 0, has_b = stat(b.c_str(), &of_b) == 0;
  if (has_a != has_b || (has_a && (is_stream(of_a) || is_stream(of_b)))) return false;
  if (has_a) return of_a.st_dev == of_b.st_dev && of_a.st_ino == of_b.st_ino;
  return place_of(a) == place_of(b);
}

void require_separate(std::span<const NamedPath> paths) {
  require_answers(paths);
  for (std::size_t i = 0; i < paths.size(); ++i) {
    for (std::size_t j = 0; j < i; ++j) {
      const NamedPath& written = paths[i].written ? paths[i] : paths[j];
      const NamedPath& other = paths[i].written ? paths[j] : paths[i];
      if (!written.written || !(other.written || is_there(other.path)) ||
          !is_same_file(written.path, other.path))
        continue;
      const std::string both =
          written.option + " " + written.path + ": that is the file of " + other.option + " " + other.path;
      throw InputError(both + (other.written ? ", which is written, too; name another file"
                                             : ", which is to be read, not written over; name another file"));
    }
  }
}

}  // namespace pbmpi::core
