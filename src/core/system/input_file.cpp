#include "core/system/input_file.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>

#include "core/error.h"
#include "core/system/descriptor.h"

namespace pbmpi::core {
namespace {

/// An open regular file.
class InputFile {
 public:
  // Without O_NONBLOCK opening a pipe waits for a writer before anything can be asked of it.
  InputFile(const std::string& path, const std::string& advice)
      : path_(path), advice_(advice), file_(path, O_RDONLY | O_NONBLOCK) {
    if (!file_.is_open()) refuse(errno == ENOENT ? "there is no such file" : reason_of(errno));
    struct stat status {};
    if (fstat(file_.get(), &status) != 0) refuse(reason_of(errno));
    if (S_ISDIR(status.st_mode)) refuse("it is a directory");
    if (!S_ISREG(status.st_mode)) refuse("it is a pipe or a device and no regular file");
    num_bytes_ = static_cast<std::size_t>(status.st_size);
  }

  std::size_t num_bytes() const { return num_bytes_; }

  std::string read_all() {
    std::string bytes(num_bytes_, '\0');
    std::size_t done = 0;
    while (done < bytes.size()) {
      const ssize_t got = read(file_.get(), bytes.data() + done, bytes.size() - done);
      if (got < 0 && errno == EINTR) continue;
      if (got < 0) refuse(reason_of(errno));
      if (got == 0) break;
      done += static_cast<std::size_t>(got);
    }
    bytes.resize(done);
    return bytes;
  }

  [[noreturn]] void refuse(const std::string& why) const {
    throw InputError(path_ + ": cannot be read: " + why + "; " + advice_);
  }

 private:
  const std::string& path_;
  const std::string& advice_;
  Descriptor file_;
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
