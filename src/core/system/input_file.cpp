#include "core/system/input_file.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <system_error>
#include <utility>

#include "core/error.h"

namespace pbmpi::core {
namespace {

/// An open regular file.
class InputFile {
 public:
  InputFile(const std::string& path, const std::string& advice) : path_(path), advice_(advice) {
    // Without O_NONBLOCK a pipe waits for a writer before anything can be asked of it.
    file_ = open(path.c_str(), O_RDONLY | O_NONBLOCK | O_CLOEXEC);
    if (file_ < 0) refuse(errno == ENOENT ? "there is no such file" : std::generic_category().message(errno));
    struct stat status {};
    if (fstat(file_, &status) != 0) refuse(std::generic_category().message(errno));
    if (S_ISDIR(status.st_mode)) refuse("it is a directory");
    if (!S_ISREG(status.st_mode)) refuse("it is a pipe or a device and no regular file");
    num_bytes_ = static_cast<std::size_t>(status.st_size);
  }
  ~InputFile() {
    if (file_ >= 0) close(file_);
  }
  InputFile(const InputFile&) = delete;
  InputFile& operator=(const InputFile&) = delete;

  std::size_t num_bytes() const { return num_bytes_; }

  std::string read_all() {
    std::string bytes(num_bytes_, '\0');
    std::size_t done = 0;
    while (done < bytes.size()) {
      const ssize_t got = read(file_, bytes.data() + done, bytes.size() - done);
      if (got < 0 && errno == EINTR) continue;
      if (got < 0) refuse(std::generic_category().message(errno));
      if (got == 0) break;
      done += static_cast<std::size_t>(got);
    }
    bytes.resize(done);
    return bytes;
  }

  [[noreturn]] void refuse(const std::string& why) {
    if (file_ >= 0) close(std::exchange(file_, -1));
    throw InputError(path_ + ": cannot be read: " + why + "; " + advice_);
  }

 private:
  const std::string& path_;
  const std::string& advice_;
  int file_ = -1;
  std::size_t num_bytes_ = 0;
};

}  // namespace

void require_readable_file(const std::string& path, const std::string& advice) {
  const InputFile opened_and_closed(path, advice);
}

std::string read_input_file(const std::string& path, const std::string& advice, std::size_t most_bytes) {
  InputFile file(path, advice);
  if (file.num_bytes() > most_bytes)
    file.refuse("it has " + std::to_string(file.num_bytes() >> 20) + " MiB, and at most " +
                std::to_string(most_bytes >> 20) + " are read");
  return file.read_all();
}

}  // namespace pbmpi::core
